// Surfaces of bodies are triangles whose corners are doubles, since a pair may be enlarged by 1e9.
import type { BodyView, ShapeView, Triple } from "../bundle";
import { polygonHull } from "d3-polygon";
import { add, beside, cross, dot, norm, placed, subtract, support, times, unit } from "./vectors";

export interface Surface {
  points: Triple[];
  triangles: [number, number, number][];
  edges: [number, number][]; // a curved body has none
}

const box_faces = [
  [0, 4, 6, 2],
  [1, 3, 7, 5],
  [0, 1, 5, 4],
  [2, 6, 7, 3],
  [0, 2, 3, 1],
  [4, 5, 7, 6],
];

function polytope(vertices: Triple[], faces: number[][]): Surface {
  const triangles: [number, number, number][] = [];
  const edges: [number, number][] = [];
  for (const face of faces) {
    face.forEach((corner, k) => {
      const next = face[(k + 1) % face.length]!;
      // Two faces share an edge, unless there is only one.
      if (corner < next || faces.length === 1) edges.push([corner, next]);
      if (k > 0 && k + 1 < face.length) triangles.push([face[0]!, corner, next]);
    });
  }
  return { points: vertices, triangles, edges };
}

export const is_polytope = (shape: ShapeView): boolean => shape.type === "box" || shape.type === "hull";

// A curved body is drawn by circles around its pole. The angles are between the pole and each circle, radians.
export interface Fineness {
  angles: number[];
  sides: number;
}

export const even = (rings: number, sides: number): Fineness => ({
  angles: Array.from({ length: rings }, (_, i) => (Math.PI * (i + 1)) / (rings + 1)),
  sides,
});

// The circles are closest around the pole, so that a contact there is smooth however much it is magnified.
export function magnified(): Fineness {
  const { angles } = even(47, 48);
  for (let power = -8; power < -1.2; power += 0.1) angles.push(10 ** power);
  return { angles: angles.sort((a, b) => a - b), sides: 48 };
}

// The surface lies in the world. A curved body has the unit vector `pole` as its pole. A half-space is a square of
// `reach` metres around the point of it nearest to `near`.
export function surface_of(
  body: BodyView,
  pole: Triple,
  near: Triple,
  reach: number,
  fineness: Fineness,
): Surface {
  const { shape } = body;
  if (shape.type === "halfspace") return half_space(body, near, reach);
  if (is_polytope(shape)) {
    const h = shape.half_extents ?? [0, 0, 0];
    const corners: Triple[] = [];
    for (let i = 0; i < 8; ++i) {
      corners.push([i & 1 ? h[0] : -h[0], i & 2 ? h[1] : -h[1], i & 4 ? h[2] : -h[2]]);
    }
    const vertices = shape.type === "box" ? corners : (shape.vertices ?? []);
    const faces = shape.type === "box" ? box_faces : (shape.faces ?? []);
    const points = vertices.map((v) => placed(body, v));
    return polytope(points, faces.length > 0 ? faces : [outline(points)]);
  }
  return around(body, pole, fineness);
}

// A set of points without faces has an outline: a flat one has a polygon, a segment or a point its ends.
function outline(points: Triple[]): number[] {
  const furthest = (height: (point: Triple) => number): Triple =>
    points.reduce((best, point) => (height(point) > height(best) ? point : best), points[0]!);
  const from = points[0]!;
  const along = subtract(furthest((p) => norm(subtract(p, from))), from);
  const off_line = (p: Triple): number => norm(cross(subtract(p, from), along));
  const aside = furthest(off_line);
  const u = unit(along),
    v = unit(cross(cross(along, subtract(aside, from)), along));
  const flat = points.map((p, i): [number, number, number] => [dot(p, u), dot(p, v), i]);
  const polygon = off_line(aside) > 0 ? polygonHull(flat.map(([x, y]) => [x, y])) : null;
  if (!polygon) return [0, points.findIndex((p) => p === furthest((q) => norm(subtract(q, from))))];
  return polygon.map(([x, y]) => flat.findIndex((each) => each[0] === x && each[1] === y));
}

// The surface has the support points in directions on circles around the pole.
function around(body: BodyView, pole: Triple, { angles, sides }: Fineness): Surface {
  const [u, v] = beside(pole);
  const points = [support(body, pole)];
  for (const angle of angles) {
    for (let k = 0; k < sides; ++k) {
      const way = (2 * Math.PI * k) / sides;
      const across = add(times(Math.cos(way), u), times(Math.sin(way), v));
      points.push(support(body, add(times(Math.cos(angle), pole), times(Math.sin(angle), across))));
    }
  }
  points.push(support(body, times(-1, pole)));
  const triangles: [number, number, number][] = [];
  const ring = (i: number, k: number): number => 1 + i * sides + (k % sides);
  for (let k = 0; k < sides; ++k) {
    triangles.push([0, ring(0, k), ring(0, k + 1)]);
    for (let i = 0; i + 1 < angles.length; ++i) {
      triangles.push([ring(i, k), ring(i + 1, k), ring(i + 1, k + 1)]);
      triangles.push([ring(i, k), ring(i + 1, k + 1), ring(i, k + 1)]);
    }
    triangles.push([ring(angles.length - 1, k + 1), ring(angles.length - 1, k), points.length - 1]);
  }
  return { points, triangles, edges: [] };
}

function half_space(body: BodyView, near: Triple, reach: number): Surface {
  // Planes map by the inverse transpose; its cofactors have the same direction.
  const m = body.matrix;
  const n = body.shape.normal ?? [0, 0, 1];
  const cofactor = (i: number, j: number): number => {
    const at = (r: number, c: number): number => m[3 * ((i + r) % 3) + ((j + c) % 3)]!;
    return at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1);
  };
  const turned = [0, 1, 2].map(
    (i) => cofactor(i, 0) * n[0] + cofactor(i, 1) * n[1] + cofactor(i, 2) * n[2],
  ) as Triple;
  const determinant = m[0]! * cofactor(0, 0) + m[1]! * cofactor(0, 1) + m[2]! * cofactor(0, 2);
  const length = Math.hypot(...turned) * Math.sign(determinant || 1);
  const out = times(1 / length, turned);
  const offset = ((body.shape.offset ?? 0) * Math.abs(determinant)) / Math.abs(length);
  const t = body.translation;
  const height =
    out[0] * (near[0] - t[0]) + out[1] * (near[1] - t[1]) + out[2] * (near[2] - t[2]) - offset;
  const centre = add(near, times(-height, out));
  const [u, v] = beside(out);
  const corners = [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].map(([x, y]) => add(centre, add(times(x! * reach, u), times(y! * reach, v))));
  return polytope(corners, [[0, 1, 2, 3]]);
}

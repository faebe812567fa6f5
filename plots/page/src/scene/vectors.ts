// These vectors have doubles, because graphics has single precision alone, which a gap of 1e-9 does not survive.
import type { BodyView, ShapeView, Triple } from "../bundle";

export const add = (u: Triple, v: Triple): Triple => [u[0] + v[0], u[1] + v[1], u[2] + v[2]];
export const subtract = (u: Triple, v: Triple): Triple => [u[0] - v[0], u[1] - v[1], u[2] - v[2]];
export const times = (s: number, v: Triple): Triple => [s * v[0], s * v[1], s * v[2]];
export const dot = (u: Triple, v: Triple): number => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
export const norm = (v: Triple): number => Math.hypot(...v);
export const cross = (u: Triple, v: Triple): Triple => [
  u[1] * v[2] - u[2] * v[1],
  u[2] * v[0] - u[0] * v[2],
  u[0] * v[1] - u[1] * v[0],
];
export function unit(v: Triple): Triple {
  const length = norm(v);
  return length > 0 ? times(1 / length, v) : [0, 0, 1];
}

// The two unit vectors are square to each other and to a third.
export function beside(n: Triple): [Triple, Triple] {
  const axis: Triple = Math.abs(n[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  const u = unit(cross(n, axis));
  return [u, cross(n, u)];
}

type Matrix = number[];
export const turn = (m: Matrix, v: Triple): Triple => [
  m[0]! * v[0] + m[1]! * v[1] + m[2]! * v[2],
  m[3]! * v[0] + m[4]! * v[1] + m[5]! * v[2],
  m[6]! * v[0] + m[7]! * v[1] + m[8]! * v[2],
];
export const turn_back = (m: Matrix, v: Triple): Triple => [
  m[0]! * v[0] + m[3]! * v[1] + m[6]! * v[2],
  m[1]! * v[0] + m[4]! * v[1] + m[7]! * v[2],
  m[2]! * v[0] + m[5]! * v[1] + m[8]! * v[2],
];

const sign = (x: number): number => (x < 0 ? -1 : 1);

// This is the point of a shape's core that is furthest in a direction of the body, which may have any length. The
// radius is that of the ball around it, metres.
export function core_support(shape: ShapeView, g: Triple): { point: Triple; radius: number } {
  const radius = shape.radius ?? 0,
    half = shape.half_length ?? 0;
  const across = Math.hypot(g[0], g[1]);
  const rim = (z: number): Triple =>
    across > 0 ? [(radius * g[0]) / across, (radius * g[1]) / across, z] : [0, 0, z];
  switch (shape.type) {
    case "sphere":
      return { point: [0, 0, 0], radius };
    case "capsule":
      return { point: [0, 0, sign(g[2]) * half], radius };
    case "box": {
      const h = shape.half_extents ?? [0, 0, 0];
      return { point: [sign(g[0]) * h[0], sign(g[1]) * h[1], sign(g[2]) * h[2]], radius: 0 };
    }
    case "cylinder":
      return { point: rim(sign(g[2]) * half), radius: 0 };
    case "cone": {
      const tip = half * g[2],
        base = radius * across - half * g[2];
      return { point: tip > base ? [0, 0, half] : rim(-half), radius: 0 };
    }
    case "ellipsoid": {
      const r = shape.radii ?? [0, 0, 0];
      const stretched: Triple = [r[0] * g[0], r[1] * g[1], r[2] * g[2]];
      const length = norm(stretched);
      if (!(length > 0)) return { point: [0, 0, 0], radius: 0 };
      return {
        point: [
          (r[0] * stretched[0]) / length,
          (r[1] * stretched[1]) / length,
          (r[2] * stretched[2]) / length,
        ],
        radius: 0,
      };
    }
    default: {
      let best: Triple = [0, 0, 0],
        most = -Infinity;
      for (const vertex of shape.vertices ?? []) {
        const height = dot(vertex, g);
        if (height > most) [most, best] = [height, vertex];
      }
      return { point: best, radius: 0 };
    }
  }
}

// This is the point of a body that is furthest along a unit vector of the world.
export function support(body: BodyView, d: Triple): Triple {
  const { point, radius } = core_support(body.shape, turn_back(body.matrix, d));
  return add(add(turn(body.matrix, point), body.translation), times(radius, d));
}

export const placed = (body: BodyView, v: Triple): Triple =>
  add(turn(body.matrix, v), body.translation);

// The shapes of bodies become triangles here. Those of many bodies are copied into one geometry, so that one call
// draws them.
import * as THREE from "three";
import type { Slices } from "../base/slices";
import type { BodyView, ShapeView } from "../bundle";
import { even, surface_of, type Fineness } from "./surfaces";

export const is_round = ({ type }: ShapeView): boolean =>
  ["sphere", "ellipsoid", "capsule"].includes(type);

// The more triangles a curved body may have, the finer it is.
function fineness_for({ type }: ShapeView, triangles: number): Fineness {
  const rings = Math.min(9, Math.max(2, Math.round(Math.sqrt(triangles / 3.2) - 0.6)));
  const sides = Math.round(1.6 * rings) + 2;
  // The side of a cylinder has no circles between its ends, and that of a cone has one end.
  if (type === "cylinder") return { angles: [Math.PI / 4, (3 * Math.PI) / 4], sides };
  if (type === "cone") return { angles: [(3 * Math.PI) / 4], sides };
  // The straight side of a capsule lies between the two circles in the middle.
  return even(type === "capsule" ? rings + (rings % 2) : rings, sides);
}

// `reach` says how far half-spaces are drawn, metres.
export function geometry_of(
  shape: ShapeView,
  reach: number,
  wanted: number, // triangles of a curved body
): THREE.BufferGeometry {
  const fineness = fineness_for(shape, wanted);
  const body: BodyView = { shape, matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1], translation: [0, 0, 0] };
  const { points, triangles } = surface_of(body, [0, 0, 1], [0, 0, 0], reach, fineness);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
  geometry.setIndex(triangles.flat());
  geometry.computeVertexNormals();
  return geometry;
}

// One geometry has copies of the shapes of some bodies, and each vertex has the number of its body.
export async function joined(
  numbers: number[],
  of_bodies: THREE.BufferGeometry[],
  slices: Slices,
): Promise<THREE.BufferGeometry> {
  const parts = numbers.map((number) => of_bodies[number]!);
  const vertices = parts.reduce((sum, part) => sum + part.getAttribute("position").count, 0);
  const corners = parts.reduce((sum, part) => sum + part.index!.count, 0);
  const position = new Float32Array(3 * vertices),
    normal = new Float32Array(3 * vertices),
    body = new Float32Array(vertices),
    index = new Uint32Array(corners);
  let vertex = 0,
    corner = 0;
  for (const [i, part] of parts.entries()) {
    const { array, count } = part.getAttribute("position");
    position.set(array, 3 * vertex);
    normal.set(part.getAttribute("normal").array, 3 * vertex);
    body.fill(numbers[i]!, vertex, vertex + count);
    for (const own of part.index!.array) index[corner++] = vertex + own;
    vertex += count;
    await slices.rest(i, parts.length);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
  geometry.setAttribute("body", new THREE.BufferAttribute(body, 1));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return geometry;
}

// The resolution of double precision at a pair of bodies. Where the signed distance is within it, an algorithm in
// floating point may answer either way and is right.
import type { ShapeView } from "../bundle";

// This is the greatest extent of a shape along its own axes, metres. A half-space has none.
function size_of(shape: ShapeView): number {
  const { radius = 0, half_length = 0, half_extents = [0], radii = [0], vertices = [] } = shape;
  const largest = Math.max(...half_extents, ...radii);
  switch (shape.type) {
    case "sphere":
      return 2 * radius;
    case "capsule":
      return 2 * (radius + half_length);
    case "cylinder":
    case "cone":
      return 2 * Math.max(radius, half_length);
    case "halfspace":
      return 0;
    case "hull":
      return [0, 1, 2].reduce((most, axis) => {
        let low = Infinity,
          high = -Infinity;
        for (const vertex of vertices) {
          low = Math.min(low, vertex[axis]!);
          high = Math.max(high, vertex[axis]!);
        }
        return Math.max(most, high - low);
      }, 0);
    default:
      return 2 * largest;
  }
}

// A part of the pair's unit, which is the power of two above the pair's size.
const part = 128 * Number.EPSILON;

export function resolution_of(a: ShapeView, b: ShapeView): number {
  const size = Math.max(size_of(a), size_of(b));
  return size > 0 ? part * 2 ** (Math.floor(Math.log2(size)) + 1) : 0;
}

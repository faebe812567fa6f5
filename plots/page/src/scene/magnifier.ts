// The magnifier computes in doubles what graphics draws in single precision. It enlarges the place of contact, and
// stretches it along the normal, so that a gap of 1e-9 is as wide as is asked. It also cuts off what leaves the
// picture, because single precision would bend what is enlarged by 1e9.
import * as THREE from "three";
import type { Triple } from "../bundle";
import type { Surface } from "./surfaces";
import { add, dot, subtract, times } from "./vectors";

// The picture ends here, in front of the camera. Bodies have a size of about 1 in it.
const reach = 2.6;

export class Magnifier {
  constructor(
    private readonly centre: Triple,
    private readonly normal: Triple,
    private readonly size: number, // metres; it has the length 1 where nothing is enlarged
    private readonly zoom: number,
    private readonly stretch: number,
  ) {}

  private image(point: Triple): Triple {
    const from = times(this.zoom / this.size, subtract(point, this.centre));
    return add(from, times((this.stretch - 1) * dot(from, this.normal), this.normal));
  }

  // A single point that lies outside is brought into the picture.
  place(point: Triple): THREE.Vector3 {
    return new THREE.Vector3(...this.image(point)).clampLength(0, 2 * reach);
  }

  triangles(surface: Surface): THREE.BufferGeometry {
    const images = surface.points.map((point) => this.image(point));
    const corners: number[] = [];
    for (const triangle of surface.triangles) {
      const polygon = clipped(triangle.map((corner) => images[corner]!));
      for (let k = 1; k + 1 < polygon.length; ++k)
        corners.push(...polygon[0]!, ...polygon[k]!, ...polygon[k + 1]!);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
    geometry.computeVertexNormals();
    return geometry;
  }

  segments(surface: Surface): THREE.BufferGeometry {
    const ends: number[] = [];
    for (const [from, to] of surface.edges) {
      // A segment is a polygon that is folded flat, so that the same code cuts it.
      const cut = clipped([this.image(surface.points[from]!), this.image(surface.points[to]!)]);
      if (cut.length > 1) ends.push(...cut[0]!, ...cut[1]!);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(ends, 3));
    return geometry;
  }
}

// A convex polygon keeps its part within the picture's cube; the algorithm is Sutherland and Hodgman's.
function clipped(polygon: Triple[]): Triple[] {
  let left = polygon;
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-1, 1]) {
      if (left.every((point) => side * point[axis]! <= reach)) continue;
      const kept: Triple[] = [];
      left.forEach((point, i) => {
        const next = left[(i + 1) % left.length]!;
        const inside = reach - side * point[axis]!,
          inside_next = reach - side * next[axis]!;
        if (inside >= 0) kept.push(point);
        if (inside >= 0 !== inside_next >= 0) {
          kept.push(add(point, times(inside / (inside - inside_next), subtract(next, point))));
        }
      });
      left = kept;
    }
  }
  return left;
}

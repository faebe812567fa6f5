// The bodies of a scene: those of one shape are one instanced mesh. Their states colour them, and give
// them a pattern for readers who do not see the colours.
import * as THREE from "three";
import type { BodyView, Recording, ShapeView, Triple } from "../bundle";
import type { Recorded } from "./recorded";
import { even, surface_of, type Fineness } from "./surfaces";

const vertex_shader = `
attribute float state;
varying float state_of_body;
varying vec3 seen;
void main() {
  vec4 at = modelViewMatrix * instanceMatrix * vec4(position, 1.0);
  state_of_body = state;
  seen = at.xyz;
  gl_Position = projectionMatrix * at;
}`;

// Red and plain, green and striped, blue and dotted; lit from beside the eye. It does no more than that,
// since without a graphics card the processor runs it for every point of the picture.
const fragment_shader = `
varying float state_of_body;
varying vec3 seen;
void main() {
  vec3 colour = vec3(0.8, 0.28, 0.24);
  vec2 pixel = gl_FragCoord.xy;
  if (state_of_body > 1.5) {
    vec2 off = mod(pixel, 7.0) - 3.5;
    colour = dot(off, off) < 2.9 ? vec3(0.52, 0.64, 0.96) : vec3(0.26, 0.42, 0.86);
  } else if (state_of_body > 0.5) {
    colour = mod(pixel.x + pixel.y, 9.0) < 2.5 ? vec3(0.6, 0.83, 0.62) : vec3(0.24, 0.64, 0.34);
  }
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  gl_FragColor = vec4(colour * (0.66 + 0.34 * dot(normal, vec3(0.27, 0.53, 0.8))), 1.0);
}`;

const material = (): THREE.Material =>
  new THREE.ShaderMaterial({ vertexShader: vertex_shader, fragmentShader: fragment_shader });

// The more bodies there are, the smaller each is drawn, and the fewer triangles it needs.
function fineness_for(bodies: number): Fineness {
  if (bodies <= 500) return even(9, 14);
  return bodies <= 4000 ? even(5, 8) : even(3, 6);
}

function geometry_of(shape: ShapeView, reach: number, fineness: Fineness): THREE.BufferGeometry {
  const body: BodyView = { shape, matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1], translation: [0, 0, 0] };
  const { points, triangles } = surface_of(body, [0, 0, 1], [0, 0, 0], reach, fineness);
  const geometry = new THREE.BufferGeometry().setFromPoints(
    points.map((point) => new THREE.Vector3(...point)),
  );
  geometry.setIndex(triangles.flat());
  return geometry;
}

// A shape of unit size, and how far it is stretched along its axes. Bodies of different sizes are one
// mesh, where their shapes allow that: a scene may have as many sizes as bodies.
export function unit_shape(shape: ShapeView): { shape: ShapeView; size: Triple } {
  const { type, half_extents, radii, radius = 0, half_length = 0 } = shape;
  if (type === "box" && half_extents) return { shape: { type, half_extents: [1, 1, 1] }, size: half_extents };
  if (type === "ellipsoid" && radii) return { shape: { type, radii: [1, 1, 1] }, size: radii };
  if (type === "sphere") return { shape: { type, radius: 1 }, size: [radius, radius, radius] };
  if (type === "cylinder" || type === "cone") {
    return { shape: { type, radius: 1, half_length: 1 }, size: [radius, radius, half_length] };
  }
  return { shape, size: [1, 1, 1] };
}

interface Group {
  bodies: number[];
  sizes: Triple[]; // of the bodies
  meshes: THREE.InstancedMesh[]; // one a view
  states: THREE.InstancedBufferAttribute[];
}

export class Bodies {
  private readonly groups: Group[];
  private readonly matrix = new THREE.Matrix4();
  private readonly at = new THREE.Vector3();
  private readonly turn = new THREE.Quaternion();
  private readonly size = new THREE.Vector3();
  private readonly nowhere = new THREE.Matrix4().makeScale(0, 0, 0);

  // `reach` is how far half-spaces are drawn.
  constructor(
    private readonly recording: Recording,
    private readonly recorded: Recorded,
    scene: THREE.Scene,
    reach: number,
  ) {
    const box: ShapeView = { type: "box", half_extents: [1, 1, 1] };
    const shapes = recording.boxes_only ? [box] : recording.shapes;
    const units = shapes.map(unit_shape);
    const of_unit = new Map<string, { shape: ShapeView; bodies: number[]; sizes: Triple[] }>();
    for (let body = 0; body < recorded.bodies; ++body) {
      const { shape, size } = units[recording.boxes_only ? 0 : recording.shape_of[body]!]!;
      const name = JSON.stringify(shape);
      const group = of_unit.get(name) ?? { shape, bodies: [], sizes: [] };
      group.bodies.push(body);
      group.sizes.push(size);
      of_unit.set(name, group);
    }
    this.groups = [...of_unit.values()].map(({ shape, bodies, sizes }) =>
      this.group(shape, bodies, sizes, reach, scene),
    );
  }

  private group(
    shape: ShapeView,
    bodies: number[],
    sizes: Triple[],
    reach: number,
    scene: THREE.Scene,
  ): Group {
    const base = geometry_of(shape, reach, fineness_for(this.recorded.bodies));
    const group: Group = { bodies, sizes, meshes: [], states: [] };
    for (const view of [0, 1]) {
      // The views differ in their bodies' states alone, and share all other numbers.
      const geometry = new THREE.BufferGeometry();
      for (const [name, attribute] of Object.entries(base.attributes))
        geometry.setAttribute(name, attribute);
      geometry.setIndex(base.index);
      const states = new THREE.InstancedBufferAttribute(new Float32Array(bodies.length), 1);
      geometry.setAttribute("state", states);
      const mesh = new THREE.InstancedMesh(geometry, material(), bodies.length);
      mesh.frustumCulled = false;
      mesh.layers.set(view + 1);
      if (view > 0) mesh.instanceMatrix = group.meshes[0]!.instanceMatrix;
      scene.add(mesh);
      group.meshes.push(mesh);
      group.states.push(states);
    }
    return group;
  }

  move(frame: number): void {
    const poses = this.recorded.poses(frame),
      boxes = this.recorded.boxes(frame);
    for (const { bodies, sizes, meshes } of this.groups) {
      const [mesh] = meshes;
      bodies.forEach((body, i) =>
        mesh!.setMatrixAt(i, this.matrix_of(body, sizes[i]!, poses, boxes)),
      );
      mesh!.instanceMatrix.needsUpdate = true;
    }
  }

  colour(view: number, of_bodies: Float32Array): void {
    for (const { bodies, states } of this.groups) {
      const attribute = states[view]!;
      bodies.forEach((body, i) => (attribute.array[i] = of_bodies[body]!));
      attribute.needsUpdate = true;
    }
  }

  get meshes(): THREE.InstancedMesh[] {
    return this.groups.map((group) => group.meshes[0]!);
  }

  // The body that a ray has hit.
  body_of(hit: THREE.Intersection | undefined): number {
    const group = this.groups.find((each) => each.meshes[0] === hit?.object);
    return group && hit?.instanceId !== undefined ? group.bodies[hit.instanceId]! : -1;
  }

  private matrix_of(
    body: number,
    size: Triple,
    poses: Float32Array,
    boxes: Float32Array,
  ): THREE.Matrix4 {
    const box = 6 * body;
    if (!(boxes[box]! <= boxes[box + 3]!)) return this.nowhere;
    if (this.recording.boxes_only) {
      this.at.set(
        boxes[box]! + boxes[box + 3]!,
        boxes[box + 1]! + boxes[box + 4]!,
        boxes[box + 2]! + boxes[box + 5]!,
      );
      this.size.set(
        boxes[box + 3]! - boxes[box]!,
        boxes[box + 4]! - boxes[box + 1]!,
        boxes[box + 5]! - boxes[box + 2]!,
      );
      return this.matrix.compose(
        this.at.multiplyScalar(0.5),
        this.turn.identity(),
        this.size.multiplyScalar(0.5),
      );
    }
    const pose = 7 * body;
    this.at.fromArray(poses, pose);
    this.turn.set(poses[pose + 4]!, poses[pose + 5]!, poses[pose + 6]!, poses[pose + 3]!);
    return this.matrix.compose(this.at, this.turn, this.size.set(...size));
  }
}

// The bodies of a scene: those of one shape are one instanced mesh. Their states colour them, and give
// them a pattern for readers who do not see the colours.
import * as THREE from "three";
import type { BodyView, Recording, ShapeView } from "../bundle";
import type { Recorded } from "./recorded";
import { even, surface_of, type Fineness } from "./surfaces";

// Red and plain, green and striped, blue and dotted.
const state_pattern = `
#include <color_fragment>
vec3 of_state = state_of_body < 0.5 ? vec3(0.62, 0.09, 0.07) : state_of_body < 1.5 ? vec3(0.06, 0.42, 0.12) : vec3(0.06, 0.16, 0.72);
vec2 pixel = gl_FragCoord.xy;
if (state_of_body > 1.5) {
  if (length(mod(pixel, 7.0) - 3.5) < 1.7) of_state = vec3(0.75, 0.82, 1.0);
} else if (state_of_body > 0.5) {
  if (mod(pixel.x + pixel.y, 9.0) < 2.5) of_state = vec3(0.6, 0.85, 0.6);
}
diffuseColor.rgb = of_state;
`;

function material(): THREE.Material {
  const made = new THREE.MeshLambertMaterial({ flatShading: true });
  made.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace(
        "#include <common>",
        "#include <common>\nattribute float state;\nvarying float state_of_body;",
      )
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nstate_of_body = state;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float state_of_body;")
      .replace("#include <color_fragment>", state_pattern);
  };
  return made;
}

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
  geometry.computeVertexNormals();
  return geometry;
}

interface Group {
  bodies: number[];
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
    const box: ShapeView = { type: "box", half_extents: [0.5, 0.5, 0.5] };
    const shapes = recording.boxes_only ? [box] : recording.shapes;
    const of_shape: number[][] = shapes.map(() => []);
    for (let body = 0; body < recorded.bodies; ++body) {
      of_shape[recording.boxes_only ? 0 : recording.shape_of[body]!]?.push(body);
    }
    this.groups = shapes.map((shape, i) => this.group(shape, of_shape[i]!, reach, scene));
  }

  private group(shape: ShapeView, bodies: number[], reach: number, scene: THREE.Scene): Group {
    const base = geometry_of(shape, reach, fineness_for(this.recorded.bodies));
    const group: Group = { bodies, meshes: [], states: [] };
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
    for (const { bodies, meshes } of this.groups) {
      const [mesh] = meshes;
      bodies.forEach((body, i) => mesh!.setMatrixAt(i, this.matrix_of(body, poses, boxes)));
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

  private matrix_of(body: number, poses: Float32Array, boxes: Float32Array): THREE.Matrix4 {
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
      return this.matrix.compose(this.at.multiplyScalar(0.5), this.turn.identity(), this.size);
    }
    const pose = 7 * body;
    this.at.fromArray(poses, pose);
    this.turn.set(poses[pose + 4]!, poses[pose + 5]!, poses[pose + 6]!, poses[pose + 3]!);
    return this.matrix.compose(this.at, this.turn, this.size.set(1, 1, 1));
  }
}

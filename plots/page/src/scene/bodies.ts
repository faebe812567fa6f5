// The bodies of a scene are two meshes, the round bodies and the others: each vertex knows its body, and a texture
// has the bodies' poses. So a frame takes two calls. Instanced meshes would be slow, because a browser without a
// graphics card takes as long for an instance as for a call.
import * as THREE from "three";
import type { Slices } from "../base/slices";
import type { Recording, ShapeView } from "../bundle";
import { body_material, packed_states, type Look } from "./body_material";
import { geometry_of, is_round, joined } from "./body_shapes";
import type { Recorded } from "./recorded";
import { is_polytope } from "./surfaces";
import { numbers_of, texels_for } from "./texels";

// All curved bodies have so many triangles together while the scene stands still, and where it plays too slowly.
// A processor draws about five triangles in a microsecond.
const triangles_of_levels = [60_000, 12_000];

interface Level {
  group: THREE.Group;
  of_bodies: THREE.BufferGeometry[];
}

export class Bodies {
  private readonly texture: THREE.DataTexture;
  private readonly shapes: ShapeView[]; // each body's
  private readonly levels: Level[] = []; // the finest comes first

  // `reach` says how far half-spaces are drawn, metres.
  static async make(
    recording: Recording,
    recorded: Recorded,
    scene: THREE.Scene,
    reach: number,
    look: Look,
    slices: Slices,
  ): Promise<Bodies> {
    const bodies = new Bodies(recording, recorded);
    const curved = bodies.shapes.filter((shape) => !is_polytope(shape)).length;
    for (const triangles of curved > 0 ? triangles_of_levels : [0]) {
      await slices.begin("making bodies");
      bodies.levels.push(await bodies.level(reach, triangles / Math.max(1, curved), look, slices));
    }
    for (const { group } of bodies.levels) scene.add(group);
    bodies.hurry(false);
    return bodies;
  }

  private constructor(
    private readonly recording: Recording,
    private readonly recorded: Recorded,
  ) {
    const box: ShapeView = { type: "box", half_extents: [1, 1, 1] };
    this.shapes = Array.from({ length: recorded.bodies }, (_, body) =>
      recording.boxes_only ? box : recording.shapes[recording.shape_of[body]!]!,
    );
    this.texture = texels_for(recorded.bodies);
  }

  private async level(
    reach: number,
    triangles_of_a_body: number,
    look: Look,
    slices: Slices,
  ): Promise<Level> {
    const made = new Map<ShapeView, THREE.BufferGeometry>();
    const of_bodies: THREE.BufferGeometry[] = [];
    for (const shape of this.shapes) {
      const geometry = made.get(shape) ?? geometry_of(shape, reach, triangles_of_a_body);
      made.set(shape, geometry);
      of_bodies.push(geometry);
      await slices.rest(of_bodies.length, this.shapes.length);
    }
    const group = new THREE.Group();
    for (const round of [true, false]) {
      const alike = [...of_bodies.keys()].filter((body) => is_round(this.shapes[body]!) === round);
      if (alike.length === 0) continue;
      const geometry = await joined(alike, of_bodies, slices);
      for (const view of [0, 1]) {
        const kind = { round, upright: this.recording.boxes_only };
        const mesh = new THREE.Mesh(geometry, body_material(this.texture, view, kind, look));
        mesh.frustumCulled = false;
        mesh.layers.set(view + 1);
        group.add(mesh);
      }
    }
    return { group, of_bodies };
  }

  // A scene that plays too slowly is drawn with fewer triangles.
  hurry(on: boolean): void {
    this.levels.forEach(({ group }, place) => {
      group.visible = place === (on ? this.levels.length - 1 : 0);
    });
  }

  // Both views show the same frame, each with its own states of the bodies.
  show(frame: number, left: Float32Array, right: Float32Array): void {
    const poses = this.recorded.poses(frame),
      boxes = this.recorded.boxes(frame),
      numbers = numbers_of(this.texture);
    for (let body = 0; body < this.recorded.bodies; ++body) {
      const to = 8 * body,
        box = 6 * body,
        pose = 7 * body;
      if (this.recording.boxes_only) {
        for (let axis = 0; axis < 3; ++axis) {
          const least = boxes[box + axis]!,
            most = boxes[box + axis + 3]!;
          numbers[to + axis] = (least + most) / 2;
          numbers[to + 4 + axis] = (most - least) / 2;
        }
      } else {
        for (let axis = 0; axis < 3; ++axis) {
          numbers[to + axis] = poses[pose + axis]!;
          numbers[to + 4 + axis] = poses[pose + 4 + axis]!;
        }
        numbers[to + 7] = poses[pose + 3]!;
      }
      const present = boxes[box]! <= boxes[box + 3]!;
      numbers[to + 3] = present ? packed_states(left[body]!, right[body]!) : -1;
    }
    this.texture.needsUpdate = true;
  }

  // It is the first body on a ray, or -1.
  body_on(ray: THREE.Raycaster): number {
    const numbers = numbers_of(this.texture);
    const size = new THREE.Vector3(1, 1, 1),
      turn = new THREE.Quaternion(),
      at = new THREE.Vector3();
    let found = -1,
      nearest = Infinity;
    const probe = new THREE.Mesh();
    this.levels[0]!.of_bodies.forEach((geometry, body) => {
      const from = 8 * body;
      if (numbers[from + 3]! < 0) return;
      if (this.recording.boxes_only) size.fromArray(numbers, from + 4);
      else turn.fromArray(numbers, from + 4);
      probe.geometry = geometry;
      probe.matrixWorld.compose(at.fromArray(numbers, from), turn, size);
      const hits: THREE.Intersection[] = [];
      probe.raycast(ray, hits);
      for (const { distance } of hits) {
        if (distance < nearest) [nearest, found] = [distance, body];
      }
    });
    return found;
  }
}

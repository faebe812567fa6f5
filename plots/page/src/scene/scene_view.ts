// This view puts a recorded scene on a stage: bodies, their boxes, a broad phase's structure, and what is marked.
import * as THREE from "three";
import type { Recording } from "../bundle";
import { Bodies } from "./bodies";
import { Boxes } from "./boxes";
import type { Recorded } from "./recorded";
import type { Stage } from "./stage";

export interface Shown {
  frame: number;
  left: number; // an algorithm's place
  right: number; // an algorithm's place
  side_by_side: boolean;
  boxes: boolean;
  structure: number; // a structure's place, or -1
  selected: number; // a body, or -1
}

export class SceneView {
  private readonly bodies: Bodies;
  private readonly boxes = new Boxes(0x888888);
  private readonly structure = new Boxes(null);
  private readonly selected = new Boxes(0xffc400, 0.06, true);
  private readonly differing = new Boxes(0xd020d0, 0.03, true);

  constructor(
    private readonly stage: Stage,
    recording: Recording,
    private readonly recorded: Recorded,
  ) {
    const whole = extent(recorded.boxes(0));
    this.bodies = new Bodies(recording, recorded, stage.scene, 1.5 * whole.radius);
    for (const each of [this.boxes, this.structure, this.selected, this.differing]) {
      each.object.layers.enable(1);
      each.object.layers.enable(2);
      stage.scene.add(each.object);
    }
    stage.look_at(whole.center, whole.radius, new THREE.Vector3(1, -1.4, 0.9));
  }

  show(now: Shown): void {
    const { frame } = now;
    const boxes = this.recorded.boxes(frame);
    const left = this.recorded.states(frame, now.left);
    this.bodies.show(frame, left, now.side_by_side ? this.recorded.states(frame, now.right) : left);
    this.boxes.set(now.boxes ? boxes : new Float32Array());
    const structure = this.recorded.structure(now.structure, frame);
    this.structure.set(structure.boxes, structure.levels);
    this.selected.set(
      now.selected < 0 ? new Float32Array() : boxes.slice(6 * now.selected, 6 * now.selected + 6),
    );
    this.differing.set(this.boxes_of_differing(now, boxes));
    this.stage.draw();
  }

  // A scene that plays too slowly is drawn with less care.
  hurry(on: boolean): void {
    this.bodies.hurry(on);
    this.stage.draw();
  }

  body_at(event: PointerEvent): number {
    return this.bodies.body_on(this.stage.ray(event));
  }

  private boxes_of_differing(
    { frame, left, right, side_by_side }: Shown,
    boxes: Float32Array,
  ): Float32Array {
    if (!side_by_side) return new Float32Array();
    const { bodies } = this.recorded.pairs(frame);
    const corners: number[] = [];
    for (const pair of this.recorded.disagreements(frame, left, right)) {
      for (const body of [bodies[2 * pair]!, bodies[2 * pair + 1]!]) {
        corners.push(...boxes.subarray(6 * body, 6 * body + 6));
      }
    }
    return Float32Array.from(corners);
  }
}

// The ball is around all boxes that have an end.
function extent(corners: Float32Array): THREE.Sphere {
  const box = new THREE.Box3();
  const end = 1e30;
  for (let i = 0; i + 5 < corners.length; i += 6) {
    const least = new THREE.Vector3().fromArray(corners, i),
      most = new THREE.Vector3().fromArray(corners, i + 3);
    if (!(least.x <= most.x) || !(least.length() < end) || !(most.length() < end)) continue;
    box.expandByPoint(least).expandByPoint(most);
  }
  const sphere = box.getBoundingSphere(new THREE.Sphere());
  if (!(sphere.radius > 0)) sphere.set(new THREE.Vector3(), 1);
  return sphere;
}

// This view puts a recorded scene on a stage: bodies, their boxes, a broad phase's structure, and what is marked.
import * as THREE from "three";
import type { Slices } from "../base/slices";
import type { Recording } from "../bundle";
import { Bodies } from "./bodies";
import { Look, type Palette } from "./body_material";
import { Boxes } from "./boxes";
import type { Recorded } from "./recorded";
import type { Stage } from "./stage";

export interface Shown {
  frame: number;
  left: number; // an algorithm's place
  right: number; // an algorithm's place
  side_by_side: boolean;
  boxes: boolean;
  with_fixed: boolean; // contacts with fixed bodies colour a body too
  structure: number; // a structure's place, or -1
  selected: number; // a body, or -1
}

export class SceneView {
  private readonly look = new Look();
  private bodies!: Bodies;
  private readonly boxes = new Boxes(0x888888);
  private readonly structure = new Boxes(null);
  private readonly selected = new Boxes(0xffc400, 0.06, true);
  private readonly differing = new Boxes(0xd020d0, 0.03, true);

  static async open(
    stage: Stage,
    recording: Recording,
    recorded: Recorded,
    slices: Slices,
  ): Promise<SceneView> {
    const view = new SceneView(stage, recorded);
    const corners = ends_of(recorded);
    const whole = new THREE.Box3().setFromPoints(corners).getBoundingSphere(new THREE.Sphere());
    const reach = 1.5 * Math.max(whole.radius, 0) || 1.5;
    view.bodies = await Bodies.make(recording, recorded, stage.scene, reach, view.look, slices);
    for (const each of [view.boxes, view.structure, view.selected, view.differing]) {
      each.object.layers.enable(1);
      each.object.layers.enable(2);
      stage.scene.add(each.object);
    }
    stage.before_drawing = (grain) => (view.look.grain.value = grain);
    stage.fit(corners, new THREE.Vector3(1, -1.4, 0.9));
    return view;
  }

  private constructor(
    private readonly stage: Stage,
    private readonly recorded: Recorded,
  ) {}

  show(now: Shown): void {
    const { frame } = now;
    const boxes = this.recorded.boxes(frame);
    const states = (algorithm: number): Float32Array =>
      this.recorded.states(frame, algorithm, now.with_fixed);
    const left = states(now.left);
    this.bodies.show(frame, left, now.side_by_side ? states(now.right) : left);
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

  wear(palette: Palette): void {
    this.look.wear(palette);
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
    for (const pair of this.recorded.disagreements(frame, left, right).differing) {
      for (const body of [bodies[2 * pair]!, bodies[2 * pair + 1]!]) {
        corners.push(...boxes.subarray(6 * body, 6 * body + 6));
      }
    }
    return Float32Array.from(corners);
  }
}

// These are the corners of all boxes that have an end, in the first frame and the last.
function ends_of(recorded: Recorded): THREE.Vector3[] {
  const end = 1e30;
  const points: THREE.Vector3[] = [];
  for (const frame of new Set([0, Math.max(0, recorded.frames - 1)])) {
    const boxes = recorded.boxes(frame);
    for (let i = 0; i + 5 < boxes.length; i += 6) {
      const least = new THREE.Vector3().fromArray(boxes, i),
        most = new THREE.Vector3().fromArray(boxes, i + 3);
      if (!(least.x <= most.x) || !(least.length() < end) || !(most.length() < end)) continue;
      for (let corner = 0; corner < 8; ++corner) {
        points.push(
          new THREE.Vector3(
            corner & 1 ? most.x : least.x,
            corner & 2 ? most.y : least.y,
            corner & 4 ? most.z : least.z,
          ),
        );
      }
    }
  }
  return points;
}

// A recording's frames are decoded when they are asked for, since most pairs are never looked at.
import type { Slices } from "../base/slices";
import { doubles, floats, frames_of_floats, indices, octets, type Recording, type ShapeView } from "../bundle";
import { resolution_of } from "./resolution";

export const verdict_names = ["apart", "touching", "overlapping", "unknown"];

export interface FrameOfPairs {
  bodies: Uint32Array;
  verdicts: Uint8Array;
  distances: Float64Array;
}

// Both lists have places of pairs in a frame.
export interface Disagreements {
  differing: number[];
  within_resolution: number[];
}

export class Recorded {
  readonly bodies: number;
  readonly frames: number;
  readonly algorithms: string[];
  private readonly is_fixed: Uint8Array; // of each body
  private last: { frame: number; pairs: FrameOfPairs } | null = null;

  static async read(recording: Recording, slices: Slices): Promise<Recorded> {
    await slices.begin("reading poses");
    const poses = await frames_of_floats(recording.poses, 7 * recording.bodies, slices);
    await slices.begin("reading boxes");
    const boxes = await frames_of_floats(recording.boxes, 6 * recording.bodies, slices);
    return new Recorded(recording, poses, boxes);
  }

  private constructor(
    private readonly recording: Recording,
    private readonly all_poses: Float32Array,
    private readonly all_boxes: Float32Array,
  ) {
    this.bodies = recording.bodies;
    this.frames = recording.frames;
    this.algorithms = recording.algorithms;
    this.is_fixed = new Uint8Array(recording.bodies);
    for (const body of recording.fixed) this.is_fixed[body] = 1;
  }

  poses(frame: number): Float32Array {
    return this.all_poses.subarray(7 * frame * this.bodies, 7 * (frame + 1) * this.bodies);
  }

  boxes(frame: number): Float32Array {
    return this.all_boxes.subarray(6 * frame * this.bodies, 6 * (frame + 1) * this.bodies);
  }

  pairs(frame: number): FrameOfPairs {
    if (this.last?.frame !== frame) {
      const of_frame = this.recording.pairs[frame] ?? { bodies: "", verdicts: "", distances: "" };
      const pairs = {
        bodies: indices(of_frame.bodies),
        verdicts: octets(of_frame.verdicts),
        distances: doubles(of_frame.distances),
      };
      this.last = { frame, pairs };
    }
    return this.last.pairs;
  }

  structure(place: number, frame: number): { boxes: Float32Array; levels: Uint8Array } {
    const of_frame = this.recording.structures[place]?.frames[frame];
    return { boxes: floats(of_frame?.boxes ?? ""), levels: octets(of_frame?.levels ?? "") };
  }

  verdict(frame: number, pair: number, algorithm: number): number {
    return this.pairs(frame).verdicts[pair * this.algorithms.length + algorithm] ?? 3;
  }

  // A body's state is 0 if it is apart from all others, 1 if its box overlaps another, and 2 if it is in contact
  // with another body by the verdicts of an algorithm. Pairs with a fixed body count if `with_fixed` is true: all
  // that stands on a floor is in contact with it.
  states(frame: number, algorithm: number, with_fixed: boolean): Float32Array {
    const states = new Float32Array(this.bodies);
    const { bodies } = this.pairs(frame);
    for (let pair = 0; 2 * pair + 1 < bodies.length; ++pair) {
      if (!with_fixed && this.has_fixed(bodies, pair)) continue;
      const state = is_contact(this.verdict(frame, pair, algorithm)) ? 2 : 1;
      for (const body of [bodies[2 * pair]!, bodies[2 * pair + 1]!]) {
        if (states[body]! < state) states[body] = state;
      }
    }
    return states;
  }

  get has_fixed_bodies(): boolean {
    return this.recording.fixed.length > 0;
  }

  private has_fixed(bodies: Uint32Array, pair: number): boolean {
    return this.is_fixed[bodies[2 * pair]!] === 1 || this.is_fixed[bodies[2 * pair + 1]!] === 1;
  }

  // Two algorithms give different verdicts about these pairs; touching is contact. They differ, unless the proven
  // distance is within the resolution of double precision, where both answers are right.
  disagreements(frame: number, left: number, right: number): Disagreements {
    const found: Disagreements = { differing: [], within_resolution: [] };
    if (left === right) return found;
    const { bodies, distances } = this.pairs(frame);
    for (let pair = 0; 2 * pair + 1 < bodies.length; ++pair) {
      const of_left = this.verdict(frame, pair, left),
        of_right = this.verdict(frame, pair, right);
      const unknown = of_left === 3 || of_right === 3;
      if (is_contact(of_left) === is_contact(of_right) && (of_left === 3) === (of_right === 3))
        continue;
      const near = !unknown && Math.abs(distances[pair] ?? NaN) <= this.resolution(bodies, pair);
      (near ? found.within_resolution : found.differing).push(pair);
    }
    return found;
  }

  private resolution(bodies: Uint32Array, pair: number): number {
    const shape = (body: number): ShapeView =>
      this.recording.shapes[this.recording.shape_of[body]!]!;
    return resolution_of(shape(bodies[2 * pair]!), shape(bodies[2 * pair + 1]!));
  }
}

const is_contact = (verdict: number): boolean => verdict === 1 || verdict === 2;

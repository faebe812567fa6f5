// A recording's frames are decoded when they are asked for, since most pairs are never looked at.
import { doubles, floats, frames_of_floats, indices, octets, type Recording } from "../bundle";

export const verdict_names = ["apart", "touching", "overlapping", "unknown"];

export interface FrameOfPairs {
  bodies: Uint32Array;
  verdicts: Uint8Array;
  distances: Float64Array;
}

export class Recorded {
  readonly bodies: number;
  readonly frames: number;
  readonly algorithms: string[];
  private readonly all_poses: Float32Array;
  private readonly all_boxes: Float32Array;
  private last: { frame: number; pairs: FrameOfPairs } | null = null;

  constructor(private readonly recording: Recording) {
    this.bodies = recording.bodies;
    this.frames = recording.frames;
    this.algorithms = recording.algorithms;
    this.all_poses = frames_of_floats(recording.poses, 7 * recording.bodies);
    this.all_boxes = frames_of_floats(recording.boxes, 6 * recording.bodies);
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
  // with another body by the verdicts of an algorithm.
  states(frame: number, algorithm: number): Float32Array {
    const states = new Float32Array(this.bodies);
    const { bodies } = this.pairs(frame);
    for (let pair = 0; 2 * pair + 1 < bodies.length; ++pair) {
      const state = is_contact(this.verdict(frame, pair, algorithm)) ? 2 : 1;
      for (const body of [bodies[2 * pair]!, bodies[2 * pair + 1]!]) {
        if (states[body]! < state) states[body] = state;
      }
    }
    return states;
  }

  // Two algorithms differ about these pairs. Touching is contact.
  disagreements(frame: number, left: number, right: number): number[] {
    const differing: number[] = [];
    if (left === right) return differing;
    for (let pair = 0; 2 * pair + 1 < this.pairs(frame).bodies.length; ++pair) {
      const of_left = this.verdict(frame, pair, left),
        of_right = this.verdict(frame, pair, right);
      if (is_contact(of_left) !== is_contact(of_right) || (of_left === 3) !== (of_right === 3))
        differing.push(pair);
    }
    return differing;
  }
}

const is_contact = (verdict: number): boolean => verdict === 1 || verdict === 2;

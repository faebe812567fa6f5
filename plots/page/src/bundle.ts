// `touchstone report` puts a bundle into the page. It is zlib-compressed JSON, as base64.
import type { Slices } from "./base/slices";

export interface Bundle {
  format: 1;
  made: { version: string; commit: string; tree: string; date: string; command: string };
  origins: Record<string, string>; // each algorithm's: ours, peer or oracle
  approximate: string[]; // algorithms whose errors are known, and are no fault
  results: Results[];
  scenes: Recording[];
}

// A results folder has its CSV files here as they stand, so that no number is changed on the way.
export interface Results {
  name: string;
  folder: string;
  files: Record<string, string>;
  cases: CaseView[];
  notes: string[]; // sentences that say what could not be read, and why
}

export type Triple = [number, number, number];

// A shape is in body coordinates, with the keys of a case file and lengths in metres. `faces` are those of a hull:
// they have indices of vertices, anticlockwise as seen from outside.
export interface ShapeView {
  type: string;
  radius?: number;
  half_length?: number;
  half_extents?: Triple;
  radii?: Triple;
  normal?: Triple;
  offset?: number;
  vertices?: Triple[];
  faces?: number[][];
}

export interface BodyView {
  shape: ShapeView;
  matrix: number[]; // nine, by rows; it need not be a rotation
  translation: Triple;
}

export interface AnswerView {
  algorithm: string;
  origin: string;
  scalar: string;
  task: string;
  answer: string;
  status: string;
  distance: number | null; // metres
  lower: number | null;
  upper: number | null;
  normal: Triple | null; // from a to b
  witness_a: Triple | null;
  witness_b: Triple | null;
  // The grade is right, honest (gave up: no answer, or a status that says so), silent, crashed, hung, approximate (wrong,
  // as it is designed), or rounded (right for the pair in the algorithm's own numbers alone).
  grade: string;
  why: string; // the reason in words, unless it is right
}

// A case is a pair of bodies with what is true of it. Parts of the proof that do not apply are null.
export interface CaseView {
  id: string;
  source: string; // the path of the file that lists it
  about: string; // the reason why it is listed
  line: string; // the case as JSON, on one line
  query: string; // the command that asks all algorithms about it
  a: BodyView;
  b: BodyView;
  truth: { answer: string; lower: number | null; upper: number | null; normal: Triple | null };
  proof: {
    plane: { normal: Triple; offset: number } | null; // all of a lies below it, all of b above
    point: Triple | null; // it lies in both bodies
    on_a: Triple | null; // the shortest connection, or the two sides of the depth
    on_b: Triple | null;
    // The ball of overlapping bodies is around `on_b`. While that point stays inside, b may be moved and they overlap
    // still.
    ball: { centre: Triple; radius: number } | null;
  };
  answers: AnswerView[];
  // What versions of libraries answered when they were checked, and tests of those that have such a form.
  recorded?: {
    group: string; // of the pair's regime
    answers: AnswerView[];
    tests: { algorithm: string; file: string; text: string }[];
  };
}

// A recording is a scene that was played. Its arrays are base64 of little-endian numbers.
export interface Recording {
  name: string;
  source: string; // the scene's file
  hash: string;
  boxes_only: boolean; // there are boxes and no bodies: `shapes`, `algorithms` and `poses` are empty
  bodies: number;
  time_step: number; // seconds
  frames: number;
  frames_of_scene: number; // those beyond `frames` were left out
  shapes: ShapeView[];
  shape_of: number[]; // each body's place in `shapes`
  fixed: number[]; // the bodies that stay where they are in all frames: the scene says that they do not move
  // Frames are float32 (frames_of_floats). Each body has a translation, metres, and a quaternion (w, x, y, z).
  poses: string;
  // Frames are float32. Each body has the least and the greatest corner of its box. An absent body has an empty
  // box: its least corner is above its greatest.
  boxes: string;
  algorithms: string[]; // verdicts are in this order; the first is the reference
  pairs: FramePairs[];
  structures: Structure[]; // one for each broad phase that has one to show
}

// These are the pairs whose boxes overlap in a frame. Each has two bodies, a verdict for each algorithm (0 apart, 1
// touching, 2 overlapping, 3 unknown), and the signed distance that `certified` proves, metres (NaN: not known).
export interface FramePairs {
  bodies: string; // uint32
  verdicts: string; // uint8
  distances: string; // float64
}

// A broad phase's structure has boxes in each frame: cells, nodes or intervals.
export interface Structure {
  broad: string;
  frames: { boxes: string; levels: string }[]; // float32: least and greatest corners; uint8, one a box
}

function bytes_of(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const letters_at_once = 1 << 17; // four letters are three bytes

async function many_bytes_of(base64: string, slices: Slices): Promise<Uint8Array<ArrayBuffer>> {
  const ending = base64.endsWith("==") ? 2 : base64.endsWith("=") ? 1 : 0;
  const bytes = new Uint8Array((3 * base64.length) / 4 - ending);
  for (let from = 0; from < base64.length; from += letters_at_once) {
    bytes.set(bytes_of(base64.slice(from, from + letters_at_once)), (3 * from) / 4);
    await slices.rest(from, base64.length);
  }
  return bytes;
}

export const floats = (base64: string): Float32Array => new Float32Array(bytes_of(base64).buffer);

// All frames have as many numbers. From the second on, the bits of each are those of an exclusive or with the frame
// before, so that what does not move takes no space.
export async function frames_of_floats(
  base64: string,
  in_a_frame: number,
  slices: Slices,
): Promise<Float32Array> {
  const words = new Uint32Array((await many_bytes_of(base64, slices)).buffer);
  let done = in_a_frame;
  while (done < words.length) {
    const end = Math.min(done + (1 << 17), words.length);
    for (; done < end; ++done) words[done]! ^= words[done - in_a_frame]!;
    await slices.rest(done, words.length);
  }
  return new Float32Array(words.buffer);
}
export const doubles = (base64: string): Float64Array => new Float64Array(bytes_of(base64).buffer);
export const indices = (base64: string): Uint32Array => new Uint32Array(bytes_of(base64).buffer);
export const octets = (base64: string): Uint8Array => bytes_of(base64);

export async function read_bundle(element: HTMLElement, slices: Slices): Promise<Bundle> {
  const packed = await many_bytes_of((element.textContent ?? "").trim(), slices);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bundle = (await new Response(stream).json()) as Bundle;
  if (bundle.format !== 1) throw new Error("the page and its data are of different versions");
  return bundle;
}

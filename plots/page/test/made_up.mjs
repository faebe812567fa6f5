// Made-up data: a small campaign, pairs of bodies, and a scene of a few boxes and balls.

export const times_csv = (rows) =>
  "scene,scene_hash,bodies,boxes,threads,task,pair_kind,pairs_of,rebuild,algorithm,origin,unit,seconds,seconds_low,seconds_high,update,find_pairs,squares,samples,noisy\n" +
  rows
    .map(
      ([bodies, algorithm, origin, seconds]) =>
        `grid,h${bodies},${bodies},tight,1,,,,0,${algorithm},${origin},frame,${seconds},${seconds * 0.9},${seconds * 1.1},${seconds / 4},${seconds / 2},6,12,1\n`,
    )
    .join("");

export const raw_csv = (samples) =>
  "kind,scene,scene_hash,bodies,boxes,broad,narrow,scalar,task,twin,threads,rebuild,pair_kind,process,square,round,position,phase,frames,seconds,pair_count,noise\n" +
  Array.from(
    { length: samples },
    (_, i) =>
      `sample,grid,h100,100,tight,tree,,,,0,1,0,,${i % 3},${i},0,0,find_pairs,4,${0.004 + i * 1e-6},9,${i % 5 ? "" : "steal"}\n`,
  ).join("");

const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1];
const body = (shape, translation) => ({ shape, matrix: identity, translation });
const gap = 1e-9;

export const pair = {
  id: "a thin gap",
  source: "reproductions/block-0/tree.jsonl",
  about: "reproductions/block-0/tree.jsonl",
  line: '{"id":"a thin gap"}',
  query: "./touchstone query tree.jsonl --narrow all --task distance --out answers.csv",
  a: body({ type: "box", half_extents: [1, 0.5, 0.5] }, [0, 0, 0]),
  b: body({ type: "sphere", radius: 0.7 }, [1.7 + gap, 0, 0]),
  truth: { answer: "separated", lower: gap, upper: gap, normal: [1, 0, 0] },
  proof: {
    plane: { normal: [1, 0, 0], offset: 1 + gap / 2 },
    point: null,
    on_a: [1, 0, 0],
    on_b: [1 + gap, 0, 0],
    ball: null,
  },
  answers: [
    {
      algorithm: "gjk",
      origin: "ours",
      scalar: "float",
      task: "distance",
      answer: "overlapping",
      status: "ok",
      distance: 0,
      lower: null,
      upper: null,
      normal: [1, 0, 0],
      witness_a: [1, 0, 0],
      witness_b: [1, 0, 0],
      grade: "silent",
      why: "called overlapping",
    },
  ],
};

export const deep_pair = {
  ...pair,
  id: "deep",
  source: "failures/gjk-float-penetration.jsonl",
  b: body({ type: "capsule", radius: 0.3, half_length: 0.5 }, [1, 0, 0]),
  truth: { answer: "overlapping", lower: -0.3, upper: -0.3, normal: [1, 0, 0] },
  proof: {
    plane: null,
    point: null,
    on_a: [1, 0, 0],
    on_b: [0.7, 0, 0],
    ball: { centre: [0, 0, 0], radius: 0.3 },
  },
};

const base64 = (numbers) => Buffer.from(numbers.buffer).toString("base64");

// Frames as the program writes them: each number's bits beside those of the frame before.
function differences(numbers, in_a_frame) {
  const words = new Uint32Array(numbers.buffer);
  for (let i = words.length - 1; i >= in_a_frame; --i) words[i] ^= words[i - in_a_frame];
  return words;
}

// Body 2 is absent from frame 1 on; bodies 0 and 1 are close together, and the algorithms differ on them.
export function recording(frames, bodies = 3, name = "made up", distance = 0.2) {
  const poses = new Float32Array(frames * bodies * 7),
    boxes = new Float32Array(frames * bodies * 6);
  const pairs = [],
    structure = [];
  for (let frame = 0; frame < frames; ++frame) {
    for (let i = 0; i < bodies; ++i) {
      const at = [i % 30, Math.floor(i / 30) % 30, Math.floor(i / 900) + frame / frames];
      poses.set([...at, 1, 0, 0, 0], 7 * (frame * bodies + i));
      const absent = i === 2 && frame > 0;
      const box = absent
        ? [1, 1, 1, -1, -1, -1].map((x) => x * Infinity)
        : [...at.map((x) => x - 0.4), ...at.map((x) => x + 0.4)];
      boxes.set(box, 6 * (frame * bodies + i));
    }
    pairs.push({
      bodies: base64(Uint32Array.of(0, 1)),
      verdicts: base64(Uint8Array.of(0, 2)),
      distances: base64(Float64Array.of(distance)),
    });
    structure.push({
      boxes: base64(Float32Array.of(0, 0, 0, 30, 30, 30)),
      levels: base64(Uint8Array.of(0)),
    });
  }
  return {
    name,
    source: "made_up.toml",
    hash: "0123456789abcdef",
    boxes_only: false,
    bodies,
    time_step: 1 / 60,
    frames,
    frames_of_scene: frames + 2,
    shapes: [
      { type: "box", half_extents: [0.3, 0.3, 0.3] },
      { type: "sphere", radius: 0.35 },
    ],
    fixed: [],
    shape_of: Array.from({ length: bodies }, (_, i) => i % 2),
    poses: base64(differences(poses, 7 * bodies)),
    boxes: base64(differences(boxes, 6 * bodies)),
    algorithms: ["certified", "gjk"],
    pairs,
    structures: [{ broad: "uniform-grid", frames: structure }],
  };
}

export const boxes_alone = (frames) => ({
  ...recording(frames, 3, "boxes alone"),
  boxes_only: true,
  shapes: [],
  shape_of: [],
  poses: "",
  algorithms: [],
});

// What the adapters for Node.js share: the lines of results/peer_protocol.md, and a little algebra.
import { createInterface } from 'node:readline';

console.log = console.error; // standard output is for answers

// Writes the first line, and answers every question: answer(question) returns the keys of one, or null for `unsupported`.
// mesh(line), if there is one, gets the meshes. Where repeats are asked for, the answer has their time.
export async function serve(hello, answer, mesh) {
  const say = (object) => process.stdout.write(JSON.stringify(object) + '\n');
  let first = true;
  for await (const line of createInterface({ input: process.stdin })) {
    if (first) {
      say({ protocol: 1, ...hello });
    } else {
      const question = JSON.parse(line);
      if (question.id === undefined) mesh?.(question);
      else say({ id: question.id, ...(answer(question) ?? { status: 'unsupported' }), ...timed(question, answer) });
    }
    first = false;
  }
}

function timed(question, answer) {
  if (!question.repeat) return {};
  const start = process.hrtime.bigint();
  for (let i = 0; i < question.repeat; ++i) answer(question);
  return { seconds: Number(process.hrtime.bigint() - start) * 1e-9 };
}

// Matrices are by rows.
export const rotated = (m, v) => [0, 1, 2].map((i) => m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2]);
export const plus = (a, b, s = 1) => a.map((x, i) => x + s * b[i]);
export const times = (m, n) =>
  [0, 1, 2].flatMap((i) => [0, 1, 2].map((j) => m[3 * i] * n[j] + m[3 * i + 1] * n[3 + j] + m[3 * i + 2] * n[6 + j]));
export const unit = (v) => {
  const length = Math.hypot(...v);
  return length > 0 ? v.map((x) => x / length) : null;
};

export function matrixOf([w, x, y, z]) {
  return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z),
    2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
}

// The unit quaternion [w, x, y, z] of a rotation, from its greatest component.
export function quaternionOf(m) {
  const [a, b, c] = [m[0], m[4], m[8]];
  const squares = [1 + a + b + c, 1 + a - b - c, 1 - a + b - c, 1 - a - b + c];
  const at = squares.indexOf(Math.max(...squares));
  const rows = [
    [squares[0], m[7] - m[5], m[2] - m[6], m[3] - m[1]],
    [m[7] - m[5], squares[1], m[1] + m[3], m[2] + m[6]],
    [m[2] - m[6], m[1] + m[3], squares[2], m[5] + m[7]],
    [m[3] - m[1], m[2] + m[6], m[5] + m[7], squares[3]],
  ];
  return unit(rows[at]) ?? [1, 0, 0, 0];
}

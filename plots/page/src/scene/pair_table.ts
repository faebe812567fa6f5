// The table has the pairs of a body in a frame, or those about which two algorithms differ.
import { make, quiet } from "../base/dom";
import { counted } from "../base/numbers";
import { grid } from "../tables/grid";
import { Table } from "../tables/table";
import { verdict_names, type Recorded } from "./recorded";

export interface Question {
  frame: number;
  selected: number; // a body, or -1
  left: number;
  right: number;
  only_within: boolean; // lists the pairs within the resolution in place of those about which they differ
}

export function pair_table(
  recorded: Recorded,
  asked: Question,
  picked: (body: number) => void,
): HTMLElement {
  const { frame, selected, left, right, only_within } = asked;
  const { bodies, distances } = recorded.pairs(frame);
  const disagreements = recorded.disagreements(frame, left, right);
  const differing = new Set(disagreements.differing),
    within = new Set(disagreements.within_resolution);
  const shown =
    selected < 0
      ? [...(only_within ? within : differing)]
      : pairs_of(bodies, selected);
  const columns = ["first", "second", ...recorded.algorithms, "proven distance, m", "differ"];
  const rows = shown.map((pair) => [
    String(bodies[2 * pair]),
    String(bodies[2 * pair + 1]),
    ...recorded.algorithms.map(
      (_, k) => verdict_names[recorded.verdict(frame, pair, k)] ?? "unknown",
    ),
    Number.isNaN(distances[pair] ?? NaN) ? "" : String(distances[pair]),
    differing.has(pair) ? "✗" : within.has(pair) ? "within the resolution" : "",
  ]);
  return make(
    "div",
    { class: "pairs-of-frame" },
    quiet(differ_text(recorded, asked, differing.size, within.size)),
    selected >= 0
      ? make("p", {}, `Body ${selected} has ${counted(rows.length, "pair")} whose boxes overlap.`)
      : null,
    rows.length > 0
      ? grid(Table.of(columns, rows), {
          picked: (row) =>
            picked(row.number(row.number("first") === selected ? "second" : "first")),
        })
      : null,
  );
}

function differ_text(
  recorded: Recorded,
  { frame, left, right }: Question,
  differ: number,
  within: number,
): string {
  const pairs = Math.floor(recorded.pairs(frame).bodies.length / 2);
  const all = `${counted(pairs, "pair")} of boxes overlap in this frame.`;
  if (recorded.algorithms.length < 2) return all;
  const names = `${recorded.algorithms[left]} and ${recorded.algorithms[right]}`;
  const near =
    within > 0
      ? ` On ${within} they differ within the resolution of double precision (2.9e-14 of the pair), where both are right.`
      : "";
  return `${all} ${names} differ on ${differ} of them.${near}`;
}

function pairs_of(bodies: Uint32Array, body: number): number[] {
  const pairs: number[] = [];
  for (let pair = 0; 2 * pair + 1 < bodies.length; ++pair) {
    if (bodies[2 * pair] === body || bodies[2 * pair + 1] === body) pairs.push(pair);
  }
  return pairs;
}

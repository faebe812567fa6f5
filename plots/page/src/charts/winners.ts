// The matrix has the best library against the best of ours: kinds of pairs down and questions across, or scenes down and
// numbers of bodies across, unless most of its fields were empty so.
import { make, quiet } from "../base/dom";
import { count_text, interval_text, number_of, number_text } from "../base/numbers";
import { part } from "../base/section";
import { inputs_of, type Input, type Lead } from "../tables/contest";
import type { Folder } from "../tables/folder";
import { distinct, grouped } from "../tables/set";
import { has_ratio, words_of } from "./strips";

const classes: Record<Lead, string> = {
  ours: "ours",
  libraries: "library",
  equal: "equal",
  unclear: "equal",
  "no library is right": "alone",
  "none of ours is right": "library",
  "no library": "none",
};

// Two of ours that the interval of their ratio does not tell apart are equal.
function ours_of({ ours, library, first }: Input): string {
  if (!first || first.text("winner") !== ours || first.number("ratio_low") > 1) return ours;
  const next = first.text("runner_up");
  return next && next !== library ? `${ours} = ${next}` : ours;
}

function cell(inputs: Input[]): HTMLElement {
  const [input] = inputs;
  if (!input) return make("td", { class: "none" });
  // A lead of sixteen has the full colour.
  const strength = has_ratio(input) ? Math.min(1, Math.abs(Math.log(input.ratio)) / Math.log(16)) : 0;
  // Most have doubles, which goes without saying.
  const names = [ours_of(input), input.library].filter(Boolean).join(" / ").replaceAll(" double", "");
  return make(
    "td",
    {
      class: classes[input.lead],
      style: `--strength: ${Math.round(12 + 33 * strength)}%`,
      title: inputs.map((each) => `${each.name}: ${words_of(each)}`).join("\n"),
    },
    make("b", {}, has_ratio(input) ? `${input.lead === "equal" ? "= " : ""}${number_text(input.ratio)}` : input.lead),
    has_ratio(input) ? make("small", {}, ` ${interval_text(input.low, input.high)}`) : null,
    make("small", { class: "names" }, names),
    inputs.length > 1 ? make("small", {}, ` and ${inputs.length - 1} more`) : null,
  );
}

interface Shape {
  down: (input: Input) => string[];
  across: (input: Input) => string;
}

// Columns of numbers go from the least; others stay in their order.
const by_number = (a: string, b: string): number =>
  (number_of(a.replaceAll(",", "").split(" ")[0]!) || 0) - (number_of(b.replaceAll(",", "").split(" ")[0]!) || 0);

function matrix(inputs: Input[], { down, across }: Shape): HTMLElement {
  const columns = distinct(inputs.map(across)).sort(by_number);
  const parts = inputs.map(down);
  const telling = parts[0]!.map((_, i) => distinct(parts.map((each) => each[i]!)).length > 1);
  const title = (input: Input): string =>
    down(input).filter((text, i) => text !== "" && (i === 0 || telling[i])).join(", ");
  const rows = [...grouped(inputs, title)];
  return make(
    "div",
    { class: "scroll matrices", tabindex: 0, role: "region", "aria-label": "ours against libraries" },
    make(
      "table",
      { class: "matrix" },
      make("thead", {}, make("tr", {}, make("td"), ...columns.map((name) => make("th", { scope: "col" }, name)))),
      make(
        "tbody",
        {},
        ...rows.map(([name, own]) =>
          make(
            "tr",
            {},
            make("th", { scope: "row" }, name),
            ...columns.map((column) => cell(own.filter((input) => across(input) === column))),
          ),
        ),
      ),
    ),
  );
}

const words_of_threads = ({ threads }: Input): string =>
  threads === "1" ? "1 thread" : threads ? `${threads} threads` : "";

export function winners(folder: Folder): HTMLElement | null {
  const compared = inputs_of(folder).filter(({ lead }) => lead !== "no library");
  if (compared.length === 0) return null;
  const with_kinds = ({ kind, entries }: Input): boolean => entries[0]!.row.text("task") !== "" && kind !== "";
  const is_cell = ({ entries }: Input): boolean => entries[0]!.row.text("cell") !== "";
  const tables = grouped(compared, (input) => (with_kinds(input) ? "kinds" : is_cell(input) ? "cells" : "bodies"));
  // Where few scenes share a number of bodies, it stands in the row's name.
  const of_bodies = tables.get("bodies") ?? [];
  const count = ({ bodies }: Input): string => `${count_text(Number(bodies))} bodies`;
  const fields = distinct(of_bodies.map(({ scene }) => scene)).length * distinct(of_bodies.map(count)).length;
  const sparse = distinct(of_bodies.map((input) => `${input.scene}\n${count(input)}`)).length < fields / 2;
  const shapes: Record<string, Shape> = {
    kinds: {
      down: (input) => [input.kind, input.scene, words_of_threads(input)],
      across: ({ question }) => question,
    },
    cells: { down: ({ scene }) => [scene], across: ({ kind }) => kind },
    bodies: sparse
      ? { down: (input) => [input.scene, count(input), input.kind, words_of_threads(input)], across: ({ question }) => question }
      : { down: (input) => [input.scene, input.kind, words_of_threads(input)], across: count },
  };
  return part(
    `${folder.anchor}-fastest`,
    "The fastest of ours against the fastest library",
    quiet(
      "Time of the fastest correct library over that of the fastest correct algorithm of ours, with its 95 % interval. " +
        "Blue: ours is faster. Orange: a library is. Grey: equal, or unclear. Outlined: no library is right.",
    ),
    ...[...tables].map(([shape, inputs]) => matrix(inputs, shapes[shape]!)),
  );
}

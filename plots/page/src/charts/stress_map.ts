// The map shows the worst outcome of each algorithm at each value of an axis.
import * as Plot from "@observablehq/plot";
import { distinct, grouped } from "../tables/set";
import type { Row } from "../tables/table";

// Outcomes go from the best to the worst. A white sign has a contrast of at least 4.5 to 1 with its colour.
const outcomes = [
  { name: "right", colour: "#5f9e78", sign: "" },
  { name: "rounded", colour: "#44719f", sign: "~" },
  { name: "honest", colour: "#8a6d00", sign: "?" },
  { name: "silent", colour: "#b3261e", sign: "✗" },
  { name: "crashed", colour: "#7a2d8f", sign: "!" },
  { name: "hung", colour: "#6a6a6a", sign: "…" },
];

export const outcome_legend =
  "The worst outcome at each value. No sign: right. ~: rounded by the conversion to the algorithm's numbers. " +
  "?: gave up. ✗: silently wrong. !: crashed. …: hung.";

export interface Cell {
  algorithm: string;
  scalar: string;
  label: string;
  value: string;
  worst: (typeof outcomes)[number];
  tip: string;
}

function cell_of(rows: Row[]): Cell | null {
  const counts = outcomes.map(({ name }) =>
    rows.reduce((sum, row) => sum + (row.number(name) || 0), 0),
  );
  const worst = outcomes.filter((_, i) => counts[i]! > 0).pop();
  if (!worst) return null;
  const algorithm = rows[0]!.text("algorithm"),
    scalar = rows[0]!.text("scalar"),
    value = rows[0]!.text("value");
  const told = outcomes
    .map(({ name }, i) => `${counts[i]} ${name}`)
    .filter((_, i) => counts[i]! > 0);
  const label = `${algorithm} ${scalar}`;
  return {
    algorithm,
    scalar,
    label,
    value,
    worst,
    tip: `${label} at ${value}\n${told.join(", ")}`,
  };
}

export function stress_map(rows: Row[], axis: string): Element {
  const of_axis = rows.filter((row) => row.text("axis") === axis);
  const key = (row: Row): string =>
    JSON.stringify(["algorithm", "scalar", "value"].map((name) => row.text(name)));
  const cells = [...grouped(of_axis, key).values()].map(cell_of).filter((each) => each !== null);
  const values = distinct(of_axis.map((row) => row.text("value")));
  const labels = distinct(cells.map((each) => each.label));
  return Plot.plot({
    width: Math.max(700, 220 + values.length * 44),
    height: 70 + labels.length * 20,
    marginTop: 44,
    marginLeft: 200,
    ariaLabel: `worst outcomes along ${axis}`,
    x: { domain: values, label: axis, axis: "top" },
    y: { domain: labels, label: null },
    color: {
      domain: outcomes.map((each) => each.name),
      range: outcomes.map((each) => each.colour),
    },
    marks: [
      Plot.cell(cells, {
        x: "value",
        y: "label",
        fill: (each: Cell) => each.worst.name,
        inset: 0.5,
      }),
      Plot.text(cells, {
        x: "value",
        y: "label",
        text: (each: Cell) => each.worst.sign,
        fill: "white",
      }),
      Plot.tip(cells, Plot.pointer({ x: "value", y: "label", title: "tip" })),
    ],
  });
}

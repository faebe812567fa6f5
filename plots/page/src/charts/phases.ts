// A frame's time is made of building or updating, and of finding pairs.
import * as Plot from "@observablehq/plot";
import { chosen_chart } from "../base/controls";
import { quiet } from "../base/dom";
import { time_text } from "../base/numbers";
import { part } from "../base/section";
import type { Folder } from "../tables/folder";
import { distinct, grouped, set_key, set_text } from "../tables/set";
import type { Row } from "../tables/table";

const phase_names = ["build", "update", "find_pairs"];
// White letters on them have a contrast of at least 4.5 to 1.
const phase_colours = ["#94621a", "#3572ad", "#3d7d45"];

interface Bar {
  algorithm: string;
  phase: string;
  from: number;
  to: number;
}

// Where rows are updated, the frame's time has no build in it.
function bars_of(row: Row): Bar[] {
  let from = 0;
  const updated = row.number("update") > 0;
  return phase_names
    .filter((name) => row.number(name) > 0 && !(name === "build" && updated))
    .map((name) => {
      const to = from + row.number(name);
      const bar = { algorithm: row.text("algorithm"), phase: name.replace("_", " "), from, to };
      from = to;
      return bar;
    });
}

function chart_of(rows: Row[]): Element {
  const bars = rows.flatMap(bars_of);
  const shown = distinct(bars.map((bar) => bar.phase));
  const colours = phase_names
    .map((name, i): [string, string] => [name.replace("_", " "), phase_colours[i]!])
    .filter(([name]) => shown.includes(name));
  const order = [...grouped(bars, (bar) => bar.algorithm)]
    .sort(([, a], [, b]) => a[a.length - 1]!.to - b[b.length - 1]!.to)
    .map(([name]) => name);
  return Plot.plot({
    width: 960,
    height: 70 + order.length * 24,
    marginLeft: 180,
    marginBottom: 40,
    ariaLabel: "phases of a frame",
    x: { label: "time of a frame", tickFormat: time_text, grid: true },
    y: { label: null, domain: order },
    color: { domain: colours.map(([name]) => name), range: colours.map(([, colour]) => colour), legend: true },
    marks: [
      Plot.barX(bars, { x1: "from", x2: "to", y: "algorithm", fill: "phase", inset: 1 }),
      // A bar has its phase in letters where it is wide enough for them.
      Plot.text(
        bars.filter((bar) => bar.to - bar.from > 0.08 * Math.max(...bars.map((each) => each.to))),
        {
          x: (bar: Bar) => (bar.from + bar.to) / 2,
          y: "algorithm",
          text: "phase",
          fill: "white",
          fontSize: 10,
        },
      ),
      Plot.tip(
        bars,
        Plot.pointerY({
          x: (bar: Bar) => (bar.from + bar.to) / 2,
          y: "algorithm",
          title: (bar: Bar) => `${bar.algorithm}: ${bar.phase} ${time_text(bar.to - bar.from)}`,
        }),
      ),
    ],
  });
}

export function phases(folder: Folder): HTMLElement | null {
  const rows = folder
    .rows("times.csv")
    .filter((row) => phase_names.some((name) => row.number(name) > 0));
  if (rows.length === 0) return null;
  const sets = [...grouped(rows, (row) => set_key(row)).values()];
  return part(
    `${folder.anchor}-phases`,
    "Phases of a frame",
    quiet("Medians of the phases. Where a structure is updated, its one build is left out."),
    ...chosen_chart(
      "Set",
      sets.map((set) => set_text(set[0]!)),
      (place) => chart_of(sets[place]!),
    ),
  );
}

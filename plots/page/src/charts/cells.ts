// The chart shows the time of every algorithm in each cell of a group: rays, points, concave bodies, casts, features
// and scenes that move. Who was wrong there has a cross.
import * as Plot from "@observablehq/plot";
import { choice, controls, switches } from "../base/controls";
import { make, quiet } from "../base/dom";
import { time_interval, time_text } from "../base/numbers";
import { part } from "../base/section";
import type { Folder } from "../tables/folder";
import { distinct, grouped } from "../tables/set";
import type { Row } from "../tables/table";
import { colour_scale, on_click, origin_legend, symbol_scale } from "./style";

interface Mark {
  row: Row;
  cell: string;
  algorithm: string;
  origin: string;
  seconds: number;
  low: number;
  high: number;
  wrong: string; // what was wrong, in words; empty if nothing was
}

const faults = { missed: "missed", false_hits: "false hits", inexact: "inexact" };

function mark_of(row: Row): Mark {
  const wrong = Object.entries(faults)
    .filter(([column]) => row.number(column) > 0)
    .map(([column, name]) => `${row.text(column)} ${name}`)
    .join(", ");
  return {
    row,
    cell: row.text("cell"),
    algorithm: row.text("algorithm"),
    origin: row.text("origin"),
    seconds: row.number("seconds"),
    low: row.number("seconds_low"),
    high: row.number("seconds_high"),
    wrong,
  };
}

function chart_of(marks: Mark[], names: string[], cells: string[], group: string): Element {
  const shown = names.filter((name) => marks.some((each) => each.algorithm === name));
  return Plot.plot({
    width: 960,
    height: 80 + cells.length * (14 + 7 * Math.max(shown.length, 1)),
    marginLeft: 20,
    marginRight: 220,
    marginBottom: 40,
    ariaLabel: `time in each cell: ${group}`,
    x: { type: "log", label: "time a query", grid: true, tickFormat: time_text },
    // Each algorithm has a line of its own within a cell, so that no mark hides another.
    y: { label: null, axis: null, domain: shown },
    fy: { label: null, axis: "right", domain: cells },
    color: colour_scale(names),
    symbol: symbol_scale,
    marks: [
      Plot.ruleY(
        marks.filter((each) => each.low > 0 && Number.isFinite(each.high)),
        { y: "algorithm", fy: "cell", x1: "low", x2: "high", stroke: "algorithm" },
      ),
      Plot.dot(marks, {
        x: "seconds",
        y: "algorithm",
        fy: "cell",
        stroke: "algorithm",
        symbol: "origin",
        tip: true,
        title: (each: Mark) =>
          `${each.algorithm}\n${each.cell}\n${time_text(each.seconds)} (${time_interval(each.row)})` +
          (each.wrong ? `\n${each.wrong}` : ""),
      }),
      Plot.text(
        marks.filter((each) => each.wrong),
        { x: "seconds", y: "algorithm", fy: "cell", text: () => "✕", fill: "var(--wrong)", dx: 9 },
      ),
    ],
  });
}

export function time_in_cells(folder: Folder, pick: (row: Row) => void): HTMLElement | null {
  const usable = folder
    .rows("set_times.csv")
    .filter((row) => row.text("cell") !== "" && row.number("seconds") > 0);
  const groups = [...grouped(usable, (row) => row.text("group")).entries()];
  if (groups.length === 0) return null;
  const hidden = new Set<string>();
  const figure = make("figure", { class: "scroll" });
  const algorithms = make("div");

  function show(place: number): void {
    const [group, rows] = groups[place]!;
    const marks = rows.map(mark_of);
    const names = distinct(marks.map((each) => each.algorithm));
    const cells = distinct(marks.map((each) => each.cell));
    const draw = (): void => {
      const left = marks.filter((each) => !hidden.has(each.algorithm));
      const chart = chart_of(left, names, cells, group);
      on_click<Mark>(chart, (mark) => pick(mark.row));
      figure.replaceChildren(chart);
    };
    algorithms.replaceChildren(switches("Algorithms", names, hidden, draw));
    draw();
  }

  show(0);
  return part(
    `${folder.anchor}-cells`,
    "Time in each cell",
    origin_legend(),
    quiet("A cross stands beside who was wrong at least once. The tip of a mark says what was wrong."),
    controls(
      choice(
        "Group",
        groups.map(([group]) => group),
        0,
        show,
      ),
    ),
    algorithms,
    figure,
  );
}

// The chart shows time against error. Each configuration is a point.
import * as Plot from "@observablehq/plot";
import { number_text, time_interval, time_text } from "../base/numbers";
import type { Row } from "../tables/table";

export interface Point {
  row: Row;
  seconds: number;
  error: number;
  front: boolean;
}

export const points_of = (rows: Row[]): Point[] =>
  rows
    .map((row) => ({
      row,
      seconds: row.number("seconds"),
      error: row.number("error"),
      front: row.text("front") === "1",
    }))
    .filter((each) => each.seconds > 0 && Number.isFinite(each.seconds) && each.error >= 0);

// An error of zero has no place on a logarithmic axis: it stands at this one, left of all others.
export const place_of_zero = (points: Point[]): number =>
  points.reduce((low, each) => (each.error > 0 ? Math.min(low, each.error) : low), 1) / 4;

const tip_of = ({ row, seconds, error }: Point): string => {
  const configuration = [
    "representation",
    "boxes",
    "broad",
    "narrow",
    "scalar",
    "tolerance",
    "max_iterations",
  ]
    .map((column): [string, string] => [column.replace("_", " "), row.text(column)])
    .filter(([, value]) => value !== "")
    .map(([name, value]) => `${name}: ${value}`);
  return [
    `${time_text(seconds)} (${time_interval(row)})`,
    `error ${number_text(error)}`,
    ...configuration,
  ].join("\n");
};

export function front_chart(points: Point[]): Element {
  const zero = place_of_zero(points);
  const place = (each: Point): number => Math.max(each.error, zero);
  const front = points
    .filter((each) => each.front)
    .sort((a, b) => a.error - b.error || b.seconds - a.seconds);
  return Plot.plot({
    width: 960,
    height: 480,
    marginLeft: 70,
    ariaLabel: "time of a frame against error",
    x: {
      type: "log",
      label: "error",
      inset: 8,
      grid: true,
      tickFormat: (value: number) => (value <= zero * 1.01 ? "0" : number_text(value)),
    },
    y: { type: "log", label: "time of a frame", tickFormat: time_text, grid: true },
    symbol: { domain: ["other", "front"], range: ["circle", "diamond"] },
    marks: [
      Plot.ruleX([zero], { strokeDasharray: "3 3" }),
      Plot.line(front, { x: place, y: "seconds", curve: "step-after", stroke: "var(--ours)" }),
      Plot.dot(points, {
        x: place,
        y: "seconds",
        symbol: (each: Point) => (each.front ? "front" : "other"),
        stroke: (each: Point) => (each.front ? "var(--ours)" : "var(--quiet)"),
        fill: (each: Point) => (each.front ? "var(--ours)" : "none"),
        tip: true,
        title: tip_of,
      }),
    ],
  });
}

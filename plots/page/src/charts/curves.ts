// The chart shows time against the number of bodies, for sets that differ in that number alone.
import * as Plot from "@observablehq/plot";
import { choice, controls, switches } from "../base/controls";
import { make } from "../base/dom";
import { count_text, time_interval, time_text } from "../base/numbers";
import { part } from "../base/section";
import type { Folder } from "../tables/folder";
import { distinct, grouped, set_key, set_text } from "../tables/set";
import type { Row } from "../tables/table";
import { apart, colour_scale, on_click, origin_dash, origin_legend, symbol_scale } from "./style";

interface Point {
  row: Row;
  bodies: number;
  seconds: number;
  low: number;
  high: number;
  algorithm: string;
  origin: string;
}

const point_of = (row: Row): Point => ({
  row,
  bodies: row.number("bodies"),
  seconds: row.number("seconds"),
  low: row.number("seconds_low"),
  high: row.number("seconds_high"),
  algorithm: row.text("algorithm"),
  origin: row.text("origin"),
});

// The chart is as wide as the page, so that the names at the ends of its lines can be seen on a phone too.
const narrow = (): boolean => innerWidth < 700;
const margins = { height: 520, marginTop: 20, marginBottom: 40 };
const size = () =>
  narrow()
    ? { ...margins, width: Math.max(320, innerWidth - 44), marginLeft: 52, marginRight: 118, style: "font-size: 9px" }
    : { ...margins, width: 960, marginLeft: 70, marginRight: 170 };

// Curves have their names at their ends. The heights are those of the chart's logarithmic axis.
function labels(
  curves: Point[][],
  domain: [number, number],
): { bodies: number; seconds: number; name: string }[] {
  const ends = curves.map((curve) => curve[curve.length - 1]!);
  const [low, high] = domain.map(Math.log) as [number, number];
  const room = margins.height - margins.marginTop - margins.marginBottom;
  const height = (seconds: number): number => ((Math.log(seconds) - low) / (high - low)) * room;
  const moved = apart(
    ends.map((end) => height(end.seconds)),
    12,
    0,
    room,
  );
  return ends.map((end, i) => ({
    bodies: end.bodies,
    seconds: Math.exp(low + (moved[i]! / room) * (high - low)),
    name: end.algorithm,
  }));
}

function chart_of(points: Point[], all_names: string[], title: string): Element {
  const curves = [...grouped(points, (each) => each.algorithm).values()];
  const with_interval = points.filter((each) => each.low > 0 && Number.isFinite(each.high));
  const times = [
    ...points.map((each) => each.seconds),
    ...with_interval.flatMap((each) => [each.low, each.high]),
  ];
  const least = times.reduce((a, b) => Math.min(a, b), Infinity);
  const most = times.reduce((a, b) => Math.max(a, b), -Infinity);
  const domain: [number, number] = points.length > 0 ? [least / 1.1, most * 1.1] : [1e-6, 1];
  return Plot.plot({
    ...size(),
    ariaLabel: `time against the number of bodies: ${title}`,
    x: { type: "log", label: "bodies", grid: true, tickFormat: count_text },
    y: { type: "log", label: "time", tickFormat: time_text, grid: true, domain },
    color: colour_scale(all_names),
    symbol: symbol_scale,
    marks: [
      ...curves.map((curve) =>
        Plot.line(curve, {
          x: "bodies",
          y: "seconds",
          stroke: "algorithm",
          strokeDasharray: origin_dash[curve[0]!.origin] ?? "0",
        }),
      ),
      Plot.ruleX(with_interval, { x: "bodies", y1: "low", y2: "high", stroke: "algorithm" }),
      Plot.text(labels(curves, domain), {
        x: "bodies",
        y: "seconds",
        text: "name",
        fill: "name",
        textAnchor: "start",
        dx: 10,
      }),
      Plot.dot(points, {
        x: "bodies",
        y: "seconds",
        stroke: "algorithm",
        symbol: "origin",
        tip: true,
        title: (each: Point) =>
          `${each.algorithm}\n${count_text(each.bodies)} bodies\n${time_text(each.seconds)} ` +
          `(${time_interval(each.row)})`,
      }),
    ],
  });
}

export function time_against_count(folder: Folder, pick: (row: Row) => void): HTMLElement | null {
  const usable = folder
    .rows("times.csv")
    .filter((row) => row.number("seconds") > 0 && Number.isFinite(row.number("seconds")))
    .filter((row) => row.number("bodies") > 0);
  // A scene's hash differs with its number of bodies.
  const beside_count = ["bodies", "scene_hash"];
  const sets = [...grouped(usable, (row) => set_key(row, beside_count)).values()].filter(
    (rows) => distinct(rows.map((row) => row.text("bodies"))).length > 1,
  );
  if (sets.length === 0) return null;
  const titles = sets.map((rows) => set_text(rows[0]!, beside_count));
  const hidden = new Set<string>();
  const figure = make("figure", { class: "scroll" });
  const algorithms = make("div");

  function show(place: number): void {
    const points = sets[place]!.map(point_of).sort((a, b) => a.bodies - b.bodies);
    const names = distinct(points.map((each) => each.algorithm));
    const draw = (): void => {
      const shown = points.filter((each) => !hidden.has(each.algorithm));
      const chart = chart_of(shown, names, titles[place]!);
      on_click<Point>(chart, (point) => pick(point.row));
      figure.replaceChildren(chart);
    };
    algorithms.replaceChildren(switches("Algorithms", names, hidden, draw));
    draw();
  }

  show(0);
  return part(
    `${folder.anchor}-curves`,
    "Time against the number of bodies",
    origin_legend(),
    controls(choice("Set", titles, 0, show)),
    algorithms,
    figure,
  );
}

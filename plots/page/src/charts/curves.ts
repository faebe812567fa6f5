// Time against the number of bodies: a small chart for each scene, all with the same axis of time. Ours are grey, and the
// best of them is black; the best of each library has the library's colour.
import * as Plot from "@observablehq/plot";
import { choice, controls, switches } from "../base/controls";
import { make, quiet } from "../base/dom";
import { count_text, time_interval, time_text } from "../base/numbers";
import { part } from "../base/section";
import { is_library, is_ours, library_of } from "../tables/contest";
import type { Folder } from "../tables/folder";
import { distinct, grouped, set_key, set_text } from "../tables/set";
import type { Row } from "../tables/table";
import { apart, library_colour, on_click } from "./style";

interface Point {
  row: Row;
  bodies: number;
  seconds: number;
  low: number;
  high: number;
  algorithm: string;
  origin: string;
  is_right: boolean;
}

const point_of = (row: Row): Point => ({
  row,
  bodies: row.number("bodies"),
  seconds: row.number("seconds"),
  low: row.number("seconds_low"),
  high: row.number("seconds_high"),
  algorithm: row.text("algorithm"),
  origin: row.text("origin"),
  is_right: row.text("wrong") !== "1" && row.text("failure") === "",
});

// A line with a name at its end.
interface Curve {
  name: string;
  colour: string;
  points: Point[];
}

const by_bodies = (points: Point[]): Point[] => [...points].sort((a, b) => a.bodies - b.bodies);

// The fastest that is right at each number of bodies.
const best_of = (points: Point[]): Point[] =>
  by_bodies(
    [...grouped(points.filter((each) => each.is_right), (each) => String(each.bodies)).values()].map((own) =>
      own.reduce((best, each) => (each.seconds < best.seconds ? each : best)),
    ),
  );

function best_curves(points: Point[]): Curve[] {
  const libraries = grouped(
    points.filter((each) => is_library(each.origin)),
    (each) => library_of(each.algorithm),
  );
  const ours = best_of(points.filter((each) => is_ours(each.origin)));
  return [
    ...[...libraries].map(([name, own]) => ({ name, colour: library_colour(name), points: best_of(own) })),
    { name: ours[ours.length - 1]?.algorithm ?? "", colour: "var(--ink)", points: ours },
  ].filter((curve) => curve.points.length > 0);
}

const panel_height = 300;
const margins = { marginTop: 12, marginBottom: 34, marginLeft: 48, marginRight: 104 };

// Names stand at the ends of their lines. The heights are those of the chart's logarithmic axis.
function labels(curves: Curve[], domain: [number, number]): (Curve & { bodies: number; seconds: number })[] {
  const [low, high] = domain.map(Math.log) as [number, number];
  const room = panel_height - margins.marginTop - margins.marginBottom;
  const ends = curves.map(({ points }) => points[points.length - 1]!);
  const heights = ends.map(({ seconds }) => ((Math.log(seconds) - low) / (high - low)) * room);
  const moved = [...heights];
  // Only names that begin at the same number of bodies can cover each other.
  for (const places of grouped(ends.keys(), (i) => String(ends[i]!.bodies)).values()) {
    const free = apart(places.map((i) => heights[i]!), 13, 0, room);
    places.forEach((i, k) => (moved[i] = free[k]!));
  }
  return curves.map((curve, i) => ({
    ...curve,
    bodies: ends[i]!.bodies,
    seconds: Math.exp(low + (moved[i]! / room) * (high - low)),
  }));
}

const decades = ([low, high]: [number, number]): number[] =>
  Array.from({ length: 16 }, (_, i) => 10 ** (i - 10)).filter((each) => each >= low && each <= high);

function panel(points: Point[], title: string, domain: [number, number], width: number): Element {
  const curves = best_curves(points);
  const quiet_lines = [...grouped(points, (each) => each.algorithm).values()].map(by_bodies);
  const counts = distinct(points.map((each) => String(each.bodies))).map(Number).sort((a, b) => a - b);
  const bests = curves.flatMap(({ points, colour }) => points.map((point) => ({ ...point, colour })));
  return Plot.plot({
    width,
    height: panel_height,
    ...margins,
    ariaLabel: `time against the number of bodies: ${title}`,
    x: {
      type: "log",
      label: null,
      ticks: counts.filter((_, i) => counts.length <= 4 || i % Math.ceil(counts.length / 4) === 0),
      tickFormat: count_text,
      tickSize: 3,
    },
    y: { type: "log", label: null, tickFormat: time_text, ticks: decades(domain), tickSize: 0, grid: true, domain },
    color: { type: "identity" },
    marks: [
      ...quiet_lines.map((line) =>
        Plot.line(line, {
          x: "bodies",
          y: "seconds",
          z: null,
          stroke: (each: Point) => (is_library(each.origin) ? library_colour(each.algorithm) : "var(--quiet)"),
          strokeOpacity: 0.35,
          strokeWidth: 1,
          strokeDasharray: line[0]!.origin === "limit" ? "2 3" : undefined,
          ariaDescription: "algorithm",
        }),
      ),
      ...curves.map(({ points, colour }) =>
        Plot.line(points, {
          x: "bodies",
          y: "seconds",
          z: null,
          stroke: () => colour,
          strokeWidth: colour === "var(--ink)" ? 2.2 : 1.6,
          ariaDescription: "best",
        }),
      ),
      Plot.ruleX(
        bests.filter((each) => each.low > 0 && Number.isFinite(each.high)),
        { x: "bodies", y1: "low", y2: "high", stroke: "colour", strokeWidth: 1.5 },
      ),
      Plot.dot(bests, { x: "bodies", y: "seconds", fill: "colour", r: 2.5, ariaDescription: "best" }),
      ...labels(curves, domain).map((label) =>
        Plot.text([label], {
          x: "bodies",
          y: "seconds",
          text: "name",
          fill: "colour",
          stroke: "var(--ground)",
          strokeWidth: 4,
          fontWeight: label.colour === "var(--ink)" ? "bold" : "normal",
          fontSize: 11,
          textAnchor: "start",
          dx: 8,
        }),
      ),
      Plot.dot(points, {
        x: "bodies",
        y: "seconds",
        r: 4,
        fill: "transparent",
        ariaDescription: "points",
        tip: true,
        title: (each: Point) =>
          `${each.algorithm}\n${count_text(each.bodies)} bodies\n${time_text(each.seconds)} ` +
          `(${time_interval(each.row)})`,
      }),
    ],
  });
}

function panels(points: Point[], pick: (row: Row) => void): HTMLElement[] {
  const ends = points.flatMap(({ seconds, low, high }) => [seconds, low, high]);
  const usable = ends.filter((each) => each > 0 && Number.isFinite(each));
  const domain: [number, number] = [
    usable.reduce((a, b) => Math.min(a, b), Infinity) / 1.1,
    usable.reduce((a, b) => Math.max(a, b), 0) * 1.1,
  ];
  const scenes = grouped(points, ({ row }) => row.text("scene"));
  const across = Math.min(3, Math.max(2, scenes.size));
  const room = Math.min(innerWidth, 1216) - 44;
  const width = innerWidth < 700 ? room : Math.floor(room / across) - 12;
  return [...scenes].map(([scene, own]) =>
    make(
      "figure",
      { style: `width: ${width}px` },
      make("figcaption", {}, scene),
      on_click<Point>(panel(own, scene, domain, width), (point) => pick(point.row)),
    ),
  );
}

export function time_against_count(folder: Folder, pick: (row: Row) => void): HTMLElement | null {
  const usable = folder
    .rows("times.csv")
    .filter((row) => row.number("seconds") > 0 && Number.isFinite(row.number("seconds")))
    .filter((row) => row.number("bodies") > 0);
  // A scene's hash differs with its number of bodies.
  const beside_count = ["bodies", "scene_hash"];
  const curves = [...grouped(usable, (row) => set_key(row, beside_count)).values()].filter(
    (rows) => distinct(rows.map((row) => row.text("bodies"))).length > 1,
  );
  // Sets that differ in the scene stand side by side.
  const beside_scene = [...beside_count, "scene"];
  const sets = [...grouped(curves.flat(), (row) => set_key(row, beside_scene)).values()];
  if (sets.length === 0) return null;
  const titles = sets.map((rows) => set_text(rows[0]!, beside_scene) || "all");
  const hidden = new Set<string>();
  const figures = make("div", { class: "panels" });
  const algorithms = make("div");

  function show(place: number): void {
    const points = sets[place]!.map(point_of);
    const draw = (): void =>
      figures.replaceChildren(...panels(points.filter((each) => !hidden.has(each.algorithm)), pick));
    algorithms.replaceChildren(
      switches("Algorithms", distinct(points.map((each) => each.algorithm)), hidden, draw),
    );
    draw();
  }

  show(0);
  return part(
    `${folder.anchor}-curves`,
    "Time against the number of bodies",
    quiet(
      "Time up, number of bodies across. Grey: ours. Bold: the best of ours, named at its end. Colours: the best of each " +
        "library; pale: its other algorithms. Bars: 95 % intervals.",
    ),
    sets.length > 1 ? controls(choice("Set", titles, 0, show)) : null,
    figures,
    algorithms,
  );
}

// The race has a bar for each algorithm: its time over that of the fastest that is right, on a logarithmic axis. What was
// asked in some of the inputs alone stands below the others, since it is compared on less.
import * as Plot from "@observablehq/plot";
import { interval_text, number_text, time_interval, time_text } from "../base/numbers";
import { is_library, is_ours, type Standing } from "../tables/contest";

const signs = { wrong: "✕", failed: "✕", inexact: "≈", "by design": "≈" };

const colour_of = (origin: string): string =>
  is_ours(origin) ? "var(--ours)" : is_library(origin) ? "var(--peer)" : "var(--quiet)";

export const times_text = (ratio: number): string => `${number_text(ratio)} ×`;

// The marks of a logarithmic axis of ratios.
export function ratio_ticks(low: number, high: number, most: number): number[] {
  const all: number[] = [];
  for (let power = -9; power < 10; ++power) for (const digit of [1, 2, 5]) all.push(digit * 10 ** power);
  const inside = (of: number[]): number[] => of.filter((each) => each >= low * 0.999 && each <= high * 1.001);
  const fine = inside(all);
  if (fine.length <= most) return fine;
  const decades = inside(all.filter((_, i) => i % 3 === 0));
  const step = Math.ceil(decades.length / Math.max(1, most));
  return decades.filter((each) => Math.round(Math.log10(each)) % step === 0);
}

// Such an axis has every mark named: a logarithmic one of the library leaves some out.
export const ratio_axis = (ticks: number[]): Plot.Markish[] => [
  Plot.ruleX(ticks, { stroke: "var(--line)" }),
  Plot.text(ticks, { x: (tick: number) => tick, text: times_text, frameAnchor: "top", dy: -11 }),
];

const name_of = ({ algorithm, origin }: Standing): string =>
  origin === "limit" ? `${algorithm} (sort, gather, write)` : algorithm;

function tip_of(each: Standing, inputs: number): string {
  const lines = [name_of(each), `${times_text(each.relative)} (${interval_text(each.low, each.high)})`];
  if (inputs === 1) {
    const { row, seconds } = each.entries[0]!;
    lines.push(`${time_text(seconds)} (${time_interval(row)})`, `${row.text("seconds")} s`);
  }
  if (inputs > 1) lines.push(`asked in ${each.inputs} of ${inputs} inputs`);
  if (each.fault) {
    const where = inputs > 1 ? `, and in ${each.faults} of ${each.inputs} inputs something` : "";
    lines.push(`${each.fault.kind}: ${each.fault.words}${where}`);
  }
  return lines.join("\n");
}

export function race_chart(all: Standing[], inputs: number, width: number): Element {
  const whole = all.filter((each) => each.inputs === inputs);
  const rest = all.filter((each) => each.inputs < inputs);
  const rows = [...whole, ...rest];
  const row_height = 18;
  const narrow = width < 500;
  const left = narrow ? 140 : 190;
  const ends = rows.flatMap((each) => [each.relative, each.low, each.high]).filter((x) => x > 0 && Number.isFinite(x));
  const low = Math.min(1, ...ends) / 1.02,
    high = Math.max(1.5, ...ends) * 1.05;
  const margin_right = narrow ? 74 : 132;
  const place = (each: Standing): string => each.algorithm;
  // A text follows the end of its bar's interval.
  const text_at = (each: Standing): number => Math.max(each.relative, Number.isFinite(each.high) ? each.high : 0, 1);
  const text = (each: Standing): string => {
    const value = times_text(each.relative);
    const time = inputs === 1 ? `, ${time_text(each.entries[0]!.seconds)}` : "";
    const share = each.inputs < inputs ? `, in ${each.inputs} of ${inputs}` : "";
    return narrow ? value : value + time + share;
  };
  const faulty = rows.filter((each) => each.fault);
  return Plot.plot({
    width,
    height: 40 + rows.length * row_height,
    marginLeft: left,
    marginRight: margin_right,
    marginTop: 24,
    marginBottom: 16,
    ariaLabel: "time of each algorithm over that of the fastest that is right",
    style: "overflow: visible; font-size: 11.5px",
    x: {
      type: "log",
      domain: [low, high],
      axis: null,
    },
    y: { domain: rows.map(place), label: null, tickSize: 0, axis: null, padding: 0.3 },
    marks: [
      ...ratio_axis(ratio_ticks(low, high, (width - left - margin_right) / 42)),
      Plot.barX(rows, {
        x1: 1,
        x2: "relative",
        y: place,
        fill: (each: Standing) => colour_of(each.origin),
        fillOpacity: (each: Standing) => (each.fault || each.inputs < inputs ? 0.25 : 0.6),
      }),
      Plot.ruleY(
        rows.filter((each) => each.low > 0 && Number.isFinite(each.high)),
        { y: place, x1: "low", x2: "high", stroke: (each: Standing) => colour_of(each.origin), strokeWidth: 1.5 },
      ),
      Plot.dot(rows, {
        x: "relative",
        y: place,
        r: 3,
        fill: (each: Standing) => (each.fault ? "var(--ground)" : colour_of(each.origin)),
        stroke: (each: Standing) => colour_of(each.origin),
      }),
      Plot.ruleX([1], { stroke: "var(--ink)" }),
      Plot.text(rows, {
        x: low,
        y: place,
        text: (each: Standing) => shortened(name_of(each), narrow ? 18 : 26),
        textAnchor: "end",
        dx: -22,
        fill: (each: Standing) => colour_of(each.origin),
      }),
      Plot.text(faulty, {
        x: low,
        y: place,
        text: (each: Standing) => signs[each.fault!.kind],
        fill: (each: Standing) => (signs[each.fault!.kind] === "✕" ? "var(--wrong)" : "var(--quiet)"),
        fontWeight: "bold",
        dx: -10,
      }),
      Plot.text(rows, { x: text_at, y: place, text, textAnchor: "start", dx: 7, fill: "var(--quiet)" }),
      rest.length > 0 && whole.length > 0
        ? Plot.ruleY([rest[0]!.algorithm], {
            dy: -row_height / 2,
            stroke: "var(--quiet)",
            strokeDasharray: "2 3",
          })
        : null,
      Plot.tip(rows, Plot.pointerY({ x: "relative", y: place, title: (each: Standing) => tip_of(each, inputs) })),
    ],
  });
}

const shortened = (text: string, most: number): string =>
  text.length <= most ? text : `${text.slice(0, most - 1)}…`;

// Strips have the best of ours against the best library: a mark for each input, right of 1 where ours is faster.
import * as Plot from "@observablehq/plot";
import { interval_text } from "../base/numbers";
import type { Input, Lead } from "../tables/contest";
import { ratio_axis, ratio_ticks, times_text } from "./race";

const colour_of_lead: Partial<Record<Lead, string>> = {
  ours: "var(--ours)",
  libraries: "var(--peer)",
};
const colour = ({ lead }: Input): string => colour_of_lead[lead] ?? "var(--quiet)";

export const has_ratio = ({ ratio }: Input): boolean => ratio > 0 && Number.isFinite(ratio);

// All strips of a page have the same axis.
export function ratio_domain(inputs: Input[]): [number, number] {
  const ends = inputs
    .filter(has_ratio)
    .flatMap(({ ratio, low, high }) => [ratio, low, high])
    .filter((each) => each > 0 && Number.isFinite(each));
  return [Math.min(0.8, ...ends) / 1.1, Math.max(1.25, ...ends) * 1.1];
}

export const words_of = (input: Input): string => {
  const { lead, ours, library, ratio, low, high } = input;
  if (lead === "no library is right") return `no library is right; ours: ${ours}`;
  if (lead === "none of ours is right") return "none of ours is right";
  if (lead === "no library") return "no library to compare with";
  if (lead === "unclear") return "too few undisturbed rounds to tell, or not trusted";
  const interval = `${times_text(ratio)} (${interval_text(low, high)})`;
  return `${lead === "equal" ? "equal, " : ""}${interval}: ${ours} against ${library}`;
};

// A strip is one line of marks.
export function strip(inputs: Input[], domain: [number, number], width: number): Element {
  return Plot.plot({
    width,
    height: 22,
    margin: 0,
    axis: null,
    x: { type: "log", domain },
    marks: [
      Plot.ruleX(ratio_ticks(...domain, 9), { stroke: "var(--line)" }),
      Plot.ruleX([1], { stroke: "var(--ink)" }),
      Plot.tickX(inputs.filter(has_ratio), {
        x: "ratio",
        stroke: colour,
        strokeWidth: 2,
        strokeOpacity: 0.75,
        insetTop: 3,
        insetBottom: 3,
      }),
    ],
  });
}

export function strip_axis(domain: [number, number], width: number): Element {
  return Plot.plot({
    width,
    height: 18,
    margin: 0,
    x: {
      type: "log",
      domain,
      axis: null,
    },
    marks: [
      Plot.text(ratio_ticks(domain[0] * 1.1, domain[1] / 1.1, width / 42), {
        x: (tick: number) => tick,
        text: times_text,
        frameAnchor: "bottom",
        dy: -2,
      }),
    ],
  });
}

// The inputs of a question stand below each other, those in which libraries lead on top.
export function input_chart(inputs: Input[], width: number): Element {
  const place = (input: Input): string => input.key;
  const value = (input: Input): number => (has_ratio(input) ? input.ratio : 1);
  const order = (input: Input): number => (has_ratio(input) ? input.ratio : Infinity);
  const rows = [...inputs].sort((a, b) => order(a) - order(b) || 0);
  const domain = ratio_domain(inputs);
  const left = Math.min(width * 0.52, 14 + 6.1 * Math.max(...rows.map(({ name }) => name.length)));
  const letters = Math.floor((left - 10) / 6.1);
  const bare = rows.filter((each) => !has_ratio(each));
  return Plot.plot({
    width,
    height: 40 + 18 * rows.length,
    marginLeft: left,
    marginRight: 12,
    marginTop: 24,
    marginBottom: 16,
    ariaLabel: "time of the best library over that of the best of ours, for each input",
    style: "overflow: visible; font-size: 11.5px",
    x: {
      type: "log",
      domain,
      axis: null,
    },
    y: { domain: rows.map(place), axis: null },
    marks: [
      ...ratio_axis(ratio_ticks(...domain, (width - left) / 42)),
      Plot.ruleX([1], { stroke: "var(--ink)" }),
      Plot.ruleY(
        rows.filter((each) => has_ratio(each) && each.low > 0),
        { y: place, x1: "low", x2: "high", stroke: colour, strokeWidth: 2 },
      ),
      Plot.dot(rows.filter(has_ratio), {
        x: "ratio",
        y: place,
        r: 3,
        fill: (input: Input) => (input.lead === "equal" ? "var(--ground)" : colour(input)),
        stroke: colour,
      }),
      Plot.text(bare, {
        x: 1,
        y: place,
        dx: 6,
        textAnchor: "start",
        text: ({ lead }: Input) => lead,
        fill: "var(--quiet)",
        fontStyle: "italic",
      }),
      Plot.text(rows, {
        x: domain[0],
        y: place,
        dx: -8,
        textAnchor: "end",
        fill: "var(--ink)",
        text: ({ name }: Input) => (name.length <= letters ? name : `${name.slice(0, letters - 1)}…`),
      }),
      Plot.tip(rows, Plot.pointerY({ x: value, y: place, title: (input: Input) => `${input.name}\n${words_of(input)}` })),
    ],
  });
}

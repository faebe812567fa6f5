// The chart shows the ratios of one set in several results.
import * as Plot from "@observablehq/plot";
import { interval_text, number_text } from "../base/numbers";
import { distinct } from "../tables/set";

export interface Ratio {
  folder: string;
  algorithm: string;
  ratio: number;
  low: number;
  high: number;
}

export function ratio_chart(values: Ratio[], folders: string[], baseline: string): Element {
  const shown = values.filter((each) => each.ratio > 0 && Number.isFinite(each.ratio));
  // A folder has the same colour and sign in each set, and no place where it has not measured the set.
  const present = folders.filter((folder) => shown.some((each) => each.folder === folder));
  const own = (looks: string[]): string[] =>
    present.map((folder) => looks[folders.indexOf(folder) % looks.length]!);
  return Plot.plot({
    width: 960,
    height: 90 + distinct(shown.map((each) => each.algorithm)).length * (16 + 12 * present.length),
    marginLeft: 20,
    marginRight: 180,
    marginBottom: 40,
    ariaLabel: "ratios in each of the results",
    x: { type: "log", label: `time over that of ${baseline}`, inset: 8, grid: true, tickFormat: number_text },
    y: { label: null, axis: null, domain: present },
    fy: { label: null, axis: "right" },
    color: {
      domain: present,
      range: own(["var(--ours)", "var(--peer)", "var(--right)", "var(--wrong)", "var(--quiet)"]),
    },
    symbol: {
      domain: present,
      range: own(["circle", "square", "triangle", "diamond", "star"]),
      legend: true,
    },
    marks: [
      Plot.ruleX([1], { strokeDasharray: "3 3" }),
      Plot.ruleY(
        shown.filter((each) => each.low > 0 && Number.isFinite(each.high)),
        {
          y: "folder",
          fy: "algorithm",
          x1: "low",
          x2: "high",
          stroke: "folder",
        },
      ),
      Plot.dot(shown, {
        x: "ratio",
        y: "folder",
        fy: "algorithm",
        stroke: "folder",
        symbol: "folder",
        tip: true,
        title: (each: Ratio) =>
          `${each.algorithm}, ${each.folder}\n${number_text(each.ratio)} (${interval_text(each.low, each.high)})`,
      }),
    ],
  });
}

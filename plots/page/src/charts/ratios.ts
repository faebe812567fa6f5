// Ratios of one set in several results.
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
  return Plot.plot({
    width: 960,
    height: 80 + distinct(shown.map((each) => each.algorithm)).length * (16 + 12 * folders.length),
    marginLeft: 20,
    marginRight: 180,
    ariaLabel: "ratios in each of the results",
    x: { type: "log", label: `time over that of ${baseline}`, grid: true, tickFormat: number_text },
    y: { label: null, axis: null, domain: folders },
    fy: { label: null, axis: "right" },
    color: {
      domain: folders,
      range: ["var(--ours)", "var(--peer)", "var(--right)", "var(--wrong)", "var(--quiet)"],
    },
    symbol: { domain: folders, legend: true },
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

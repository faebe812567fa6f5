// Charts tell algorithms and their origins apart, with and without colour.
import { quiet } from "../base/dom";

export const origin_dash: Record<string, string> = {
  ours: "0",
  peer: "6 3",
  limit: "2 3",
  oracle: "1 4",
};
const origin_symbol: Record<string, string> = {
  ours: "circle",
  peer: "square",
  limit: "triangle",
  oracle: "cross",
};
export const symbol_scale = {
  domain: Object.keys(origin_symbol),
  range: Object.values(origin_symbol),
};

export const origin_legend = (): HTMLElement =>
  quiet(
    "Ours have circles and full lines, libraries squares and dashes, the lower limit triangles and dots. " +
      "Bars are 95 % intervals.",
  );

// The colours are as far apart as the number of names allows. Letters in them have a contrast of at least 4.5 to 1
// on light and on dark.
export function colour_scale(names: string[]): { domain: string[]; range: string[] } {
  const range = names.map((_, i) => {
    const hue = Math.round((360 * i) / Math.max(names.length, 1));
    return `light-dark(oklch(${i % 2 ? 0.4 : 0.52} 0.14 ${hue}), oklch(${i % 2 ? 0.84 : 0.73} 0.12 ${hue}))`;
  });
  return { domain: names, range };
}

// A chart remembers the datum under the pointer. A click hands it over.
export function on_click<Datum>(chart: Element, picked: (datum: Datum) => void): void {
  chart.addEventListener("click", () => {
    const datum = (chart as Element & { value?: Datum | null }).value;
    if (datum) picked(datum);
  });
}

// Labels are moved apart so that none covers another. Their heights come in the order given.
export function apart(heights: number[], least: number, low: number, high: number): number[] {
  const order = [...heights.keys()].sort((a, b) => heights[a]! - heights[b]!);
  const moved = [...heights];
  let free = low;
  for (const i of order) {
    moved[i] = Math.max(heights[i]!, free);
    free = moved[i]! + least;
  }
  let most = high;
  for (const i of order.reverse()) {
    moved[i] = Math.min(moved[i]!, most);
    most = moved[i]! - least;
  }
  return moved;
}

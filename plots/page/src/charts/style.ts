// What charts share.
import { library_of } from "../tables/contest";

// Each library has one hue on all charts. Letters in it have a contrast of at least 4.5 to 1 on light and on dark.
const hues: Record<string, number> = {
  bullet: 55,
  fcl: 250,
  ode: 150,
  mujoco: 330,
  libccd: 205,
  embree: 295,
  cgal: 110,
  boost: 20,
};

export function library_colour(algorithm: string): string {
  const name = library_of(algorithm);
  const letters = [...name].reduce((sum, letter) => sum + letter.charCodeAt(0), 0);
  const hue = hues[name] ?? (letters * 47) % 360;
  return `light-dark(oklch(0.5 0.14 ${hue}), oklch(0.78 0.12 ${hue}))`;
}

// A chart remembers the datum under the pointer. A click hands it over.
export function on_click<Datum>(chart: Element, picked: (datum: Datum) => void): Element {
  chart.addEventListener("click", () => {
    const datum = (chart as Element & { value?: Datum | null }).value;
    if (datum) picked(datum);
  });
  return chart;
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

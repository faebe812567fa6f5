// The chart shows how much faster more threads are.
import * as Plot from "@observablehq/plot";
import { chosen_chart } from "../base/controls";
import { quiet } from "../base/dom";
import { interval_text, number_text } from "../base/numbers";
import { part } from "../base/section";
import type { Folder } from "../tables/folder";
import { grouped, set_key, set_text } from "../tables/set";
import type { Row } from "../tables/table";

interface Bar {
  name: string;
  speed_up: number;
  low: number;
  high: number;
}

const bar_of = (row: Row): Bar => ({
  name: `${row.text("algorithm")}, ${row.text("threads")} threads`,
  speed_up: row.number("speed_up"),
  low: row.number("speed_up_low"),
  high: row.number("speed_up_high"),
});

function chart_of(rows: Row[]): Element {
  const bars = rows.filter((row) => row.text("threads") !== row.text("base_threads")).map(bar_of).filter((bar) => Number.isFinite(bar.speed_up));
  bars.sort((a, b) => b.speed_up - a.speed_up);
  return Plot.plot({
    width: 960,
    height: 60 + bars.length * 22,
    marginLeft: 240,
    ariaLabel: "speed-up with threads",
    x: { label: "time with the fewest threads over the time with these", grid: true, zero: true },
    y: { label: null, domain: bars.map((bar) => bar.name) },
    marks: [
      Plot.ruleX([1], { strokeDasharray: "3 3" }),
      Plot.ruleY(
        bars.filter((bar) => bar.low > 0),
        { y: "name", x1: "low", x2: "high" },
      ),
      Plot.dot(bars, {
        x: "speed_up",
        y: "name",
        fill: "var(--ours)",
        tip: true,
        title: (bar: Bar) =>
          `${bar.name}\n${number_text(bar.speed_up)} (${interval_text(bar.low, bar.high)})`,
      }),
    ],
  });
}

export function speed_up(folder: Folder): HTMLElement | null {
  const file = folder.has("speed_ups.csv") ? "speed_ups.csv" : "set_speed_ups.csv";
  if (!folder.has(file)) return null;
  const sets = [
    ...grouped(folder.rows(file), (row) => set_key(row, ["threads"])).values(),
  ];
  return part(
    `${folder.anchor}-threads`,
    "Speed-up with threads",
    quiet("Right of the dashed line more threads are faster. Lines: 95 % intervals."),
    ...chosen_chart(
      "Set",
      sets.map((set) => set_text(set[0]!, ["threads"])),
      (place) => chart_of(sets[place]!),
    ),
    folder.grid(file, { lead: ["scene", "bodies", "algorithm", "threads", "speed_up"] }),
  );
}

// The chart shows all samples of one algorithm in one set. The disturbed ones are marked.
import * as Plot from "@observablehq/plot";
import { make, quiet } from "../base/dom";
import { time_text } from "../base/numbers";
import type { Folder } from "../tables/folder";
import { set_columns, set_text } from "../tables/set";
import type { Row } from "../tables/table";

interface Sample {
  place: number;
  seconds: number; // seconds of a query or a frame
  noise: string;
}

// Tables give numbers in a label six digits, and write them as C does.
const short = (text: string): string => (text === "" ? "" : Number(text).toPrecision(6));
const comparable = (label: string): string =>
  label.replace(/ (\d[^ ]*)/g, (_, number: string) => ` ${short(number)}`);

// The tables give a row of raw.csv this label.
function label_of(raw: Row): string {
  if (raw.text("query_kind")) return comparable(raw.text("algorithm"));
  const narrow = raw.text("narrow");
  if (!narrow) return raw.text("broad");
  const gap = short(raw.text("duality_gap"));
  return [
    narrow,
    raw.text("scalar"),
    short(raw.text("tolerance")),
    gap && `gap ${gap}`,
    raw.text("warm") === "1" ? "warm" : "",
  ]
    .filter(Boolean)
    .join(" ");
}

// In raw.csv "pairs_of" is the broad phase of a narrow phase's row.
const same_columns = set_columns.filter((column) => column !== "pairs_of");

function is_in_set(raw: Row, cell: Row): boolean {
  if (raw.text("query_kind")) {
    return (
      raw.text("twin") !== "1" &&
      raw.text("input") === cell.text("group") &&
      raw.text("family") === cell.text("cell")
    );
  }
  const pairs_of = raw.text("narrow") ? raw.text("broad") : "";
  return (
    pairs_of === cell.text("pairs_of") &&
    raw.text("twin") !== "1" &&
    same_columns.every((column) => {
      const x = raw.text(column),
        y = cell.text(column);
      // A column that does not apply is 0 in one file and empty in the other.
      return x === y || (Number(x || 0) === 0 && Number(y || 0) === 0);
    })
  );
}

function samples_in(folder: Folder, cell: Row): Sample[] {
  const algorithm = comparable(cell.text("algorithm"));
  const samples = new Map<string, Sample>();
  for (const row of folder.rows("raw.csv")) {
    if (row.text("kind") !== "sample" || label_of(row) !== algorithm || !is_in_set(row, cell)) continue;
    const phase = row.text("phase");
    // A peer's conversion is a part of another phase.
    if (phase === "convert") continue;
    const is_of_queries = phase === "narrow" || phase === "answer";
    const units = row.number(is_of_queries ? "pair_count" : "frames");
    const key = ["process", "square", "round", "position"]
      .map((column) => row.text(column))
      .join("-");
    const before = samples.get(key) ?? { place: samples.size, seconds: 0, noise: "" };
    samples.set(key, {
      ...before,
      seconds: before.seconds + row.number("seconds") / units,
      noise: row.text("noise") || before.noise,
    });
  }
  return [...samples.values()].filter((each) => Number.isFinite(each.seconds));
}

export function samples_of(folder: Folder, cell: Row): HTMLElement {
  const samples = samples_in(folder, cell);
  const heading = make("h4", {}, `${cell.text("algorithm")}: ${set_text(cell)}`);
  if (samples.length === 0) return make("div", {}, heading, quiet("raw.csv has no samples of it."));
  const disturbed = samples.filter((each) => each.noise);
  const low = cell.number("seconds_low"),
    high = cell.number("seconds_high");
  const chart = Plot.plot({
    width: 960,
    height: 280,
    marginLeft: 70,
    ariaLabel: `samples of ${cell.text("algorithm")}`,
    x: { label: "sample, in the order of the run" },
    y: { label: "time", tickFormat: time_text, grid: true },
    marks: [
      Plot.rect(low > 0 && high > 0 ? [{ low, high }] : [], {
        x1: 0,
        x2: samples.length - 1,
        y1: "low",
        y2: "high",
        fill: "var(--ours)",
        fillOpacity: 0.15,
      }),
      Plot.ruleY([cell.number("seconds")].filter(Number.isFinite), { strokeDasharray: "4 3" }),
      Plot.dot(samples, {
        x: "place",
        y: "seconds",
        symbol: (each: Sample) => (each.noise ? "disturbed" : "quiet"),
        stroke: (each: Sample) => (each.noise ? "var(--wrong)" : "var(--ours)"),
        tip: true,
        title: (each: Sample) => `${time_text(each.seconds)}${each.noise ? `\n${each.noise}` : ""}`,
      }),
    ],
    symbol: { domain: ["quiet", "disturbed"], range: ["circle", "times"] },
  });
  return make(
    "div",
    {},
    heading,
    quiet(
      `${samples.length} samples, of which ${disturbed.length} were disturbed (crosses) and dropped. ` +
        "Dashed: the median. Band: its 95 % interval.",
    ),
    make("figure", { class: "scroll" }, chart),
  );
}

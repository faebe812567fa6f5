// What was raced: the inputs of a folder by question, who took part in each, and who leads. The program decides the
// leads: the page reads them from its tables of the best, as the summary does.
import { count_text, number_text } from "../base/numbers";
import type { Folder } from "./folder";
import { distinct, grouped, set_key } from "./set";
import type { Row } from "./table";

export interface Fault {
  kind: "wrong" | "inexact" | "by design" | "failed";
  words: string;
  wrong: number; // answers
  queries: number; // NaN if they are not counted
}

// One algorithm on one input, and what is wrong with its answers.
interface Graded {
  algorithm: string;
  origin: string;
  fault: Fault | null;
}

// One that was timed. Its time is over that of the fastest that is right.
export interface Entry extends Graded {
  scalar: string; // double, float, or empty
  seconds: number;
  relative: number;
  low: number;
  high: number;
  row: Row;
}

export type Lead =
  | "ours"
  | "libraries"
  | "equal" // their interval has 1 in it
  | "unclear" // too few undisturbed rounds for an interval, or the baseline differs from its twin
  | "no library is right"
  | "none of ours is right"
  | "no library";

export interface Input {
  key: string;
  question: string;
  line: string; // its question, or a scene that was asked everything, as in the summary
  name: string; // what tells it from the others of its line
  scene: string;
  bodies: string;
  kind: string;
  threads: string;
  entries: Entry[];
  graded: Graded[]; // the entries, and those that have no time
  lead: Lead;
  ours: string; // the fastest that is right, or empty
  library: string;
  ratio: number; // the time of that library over that of the fastest of ours
  low: number;
  high: number;
  first: Row | null; // of winners.csv: the fastest of all that are right, and the next
}

// The page marks a distance or depth as inexact beyond this part of the pair's size. It is usual_depth_error of
// harness/stats/tables/tables.h; tables that were made with another --depth-error lead by that one.
const depth_error = 1e-3;

// Below these nothing is said of who is faster, as in the summary (harness/stats/statistics.h). A table of the best may have
// an interval all the same, where the two were in different squares.
const fewest_squares = 6;

const questions: Record<string, string> = {
  "": "Which boxes overlap?",
  intersect: "Do two bodies touch?",
  distance: "How far apart are they?",
  penetration: "How deep do they overlap?",
  signed: "How far apart, or how deep?",
  contacts: "Where do they touch?",
};

const batch_of = (label: string): string => / by (\d+)\b/.exec(label)?.[1] ?? "";
const scalar_of = (label: string): string => /\b(double|float)\b/.exec(label)?.[1] ?? "";
const label_key = (row: Row): string => `${set_key(row)}\n${row.text("algorithm")}`;
const key_of = (row: Row, batch: string): string => `${set_key(row)}\n${batch}`;

export const is_ours = (origin: string): boolean => origin === "ours";
export const is_library = (origin: string): boolean => origin === "peer";
export const library_of = (algorithm: string): string => algorithm.split(/[- ]/)[0] ?? algorithm;

function fault_of(row: Row, agreement: Row | undefined, approximate: string[]): Fault | null {
  const failure = row.text("failure") || row.text("status").replace(/^ok$/, "");
  const none = { wrong: 0, queries: NaN };
  if (failure) return { kind: "failed", words: failure.replaceAll("_", " "), ...none };
  const name = row.text("algorithm").split(" ")[0]!;
  const by_design = row.text("approximate") === "1" || approximate.includes(name);
  const graded = agreement ?? row;
  const counts = { wrong: "on the wrong side", missed: "missed", false_hits: "false" };
  const wrong = Object.entries(counts)
    .filter(([column]) => graded.number(column) > 0)
    .map(([column, words]) => `${graded.text(column)} ${words}`);
  if (wrong.length > 0) {
    const queries = graded.number("queries");
    return {
      kind: by_design ? "by design" : "wrong",
      words: `${wrong.join(", ")}${queries > 0 ? ` of ${queries}` : ""}`,
      wrong: Object.keys(counts).reduce((all, column) => all + (graded.number(column) || 0), 0),
      queries,
    };
  }
  const error = agreement?.number("worst_error") ?? NaN;
  if (error > depth_error) {
    const bound = agreement?.text("depth_bound") === "1";
    return {
      kind: bound || by_design ? "by design" : "inexact",
      words: `${bound ? "its depth is an upper bound, too large" : "off"} by up to ${number_text(error)} of the size`,
      ...none,
    };
  }
  if (row.number("inexact") > 0)
    return { kind: by_design ? "by design" : "inexact", words: `${row.text("inexact")} inexact`, ...none };
  return null;
}

// The time over a common one: that of the baseline in the same rounds where it is known.
function relative_time(row: Row, ratio: Row | undefined): [number, number, number] {
  const columns = ["", "_low", "_high"];
  if (ratio) return columns.map((end) => ratio.number(`ratio${end}`)) as [number, number, number];
  return columns.map((end) => row.number(`seconds${end}`)) as [number, number, number];
}

function entries_of(
  rows: Row[],
  ratios: Map<string, Row>,
  agreement: Map<string, Row>,
  approximate: string[],
): Entry[] {
  const own = (all: Map<string, Row>, row: Row): Row | undefined => all.get(label_key(row));
  const paired = rows.some((row) => own(ratios, row));
  const entries = rows.map((row): Entry => {
    const ratio = own(ratios, row);
    let [relative, low, high] = relative_time(row, ratio);
    if (paired && !ratio) {
      // The baseline: its own interval is that of its time.
      const seconds = row.number("seconds");
      [relative, low, high] = [1, low / seconds, high / seconds];
    }
    return {
      algorithm: row.text("algorithm"),
      origin: row.text("origin"),
      scalar: scalar_of(row.text("algorithm")),
      seconds: row.number("seconds"),
      relative,
      low,
      high,
      fault: fault_of(row, own(agreement, row), approximate),
      row,
    };
  });
  const usable = entries.filter((each) => each.relative > 0 && Number.isFinite(each.relative));
  const right = usable.filter(
    (each) => !each.fault && (is_ours(each.origin) || is_library(each.origin)),
  );
  const best = Math.min(...(right.length > 0 ? right : usable).map((each) => each.relative));
  for (const each of usable) {
    each.relative /= best;
    each.low /= best;
    each.high /= best;
  }
  return usable.sort((a, b) => a.relative - b.relative);
}

// The grades of a set: also of algorithms whose samples were all disturbed, which have no time.
function graded_of(
  times: Row[],
  graded: Row[],
  agreement: Map<string, Row>,
  approximate: string[],
): Graded[] {
  const rows = new Map([...graded, ...times].map((row) => [label_key(row), row]));
  return [...rows].map(([label, row]) => ({
    algorithm: row.text("algorithm"),
    origin: row.text("origin"),
    fault: fault_of(row, agreement.get(label), approximate),
  }));
}

// Says who leads, from a row of a table of the best.
function lead_of(
  best: Row | undefined,
  library: string,
  ratio: string,
  entries: Entry[],
  suspect: boolean,
): Lead {
  const libraries = entries.filter((each) => is_library(each.origin));
  if (!best || best.text("ours") === "") {
    const ours = entries.filter((each) => is_ours(each.origin));
    const all_wrong = ours.length > 0 && libraries.length > 0 && ours.every(({ fault }) => fault);
    return all_wrong ? "none of ours is right" : "no library"; // or a table that was not kept
  }
  if (best.text(library) === "") return libraries.length > 0 ? "no library is right" : "no library";
  const raced = [best.text("ours"), best.text(library)];
  const few = entries.some(
    ({ algorithm, row }) => raced.includes(algorithm) && row.number("squares") < fewest_squares,
  );
  if (suspect || few) return "unclear";
  if (best.number(`${ratio}_low`) > 1) return "ours";
  if (best.number(`${ratio}_high`) < 1) return "libraries";
  return Number.isNaN(best.number(`${ratio}_low`)) ? "unclear" : "equal";
}

const variant_of = (row: Row): string =>
  [
    row.text("rebuild") === "1" ? "built anew" : "",
    row.text("boxes") === "tight" ? "" : row.text("boxes"),
    row.text("isa_limit"),
    row.text("seed") && `seed ${row.text("seed")}`,
    row.text("pairs_of") && `pairs of ${row.text("pairs_of")}`,
  ]
    .filter(Boolean)
    .join(", ");

// The inputs of each folder, which several sections show.
const made = new WeakMap<Folder, Input[]>();

export function inputs_of(folder: Folder, approximate: string[] = []): Input[] {
  const known = made.get(folder);
  if (known) return known;
  const cells = !folder.has("times.csv");
  const times = folder.rows(cells ? "set_times.csv" : "times.csv");
  const by_label = (file: string): Map<string, Row> =>
    new Map(
      folder
        .rows(file)
        .filter((row) => row.text("canary") !== "1")
        .map((row) => [label_key(row), row]),
    );
  const ratios = by_label("ratios.csv"),
    agreement = by_label("agreement.csv");
  const bests = new Map<string, [Row, string, string]>();
  for (const [file, library, ratio] of [
    ["broad_best.csv", "peer", "peer_ratio"],
    ["narrow_best.csv", "right_peer", "right_peer_ratio"],
    ["set_best.csv", "peer", "ratio"],
  ] as const) {
    for (const row of folder.rows(file))
      bests.set(key_of(row, row.text("batch")), [row, library, ratio]);
  }
  const winners = new Map(
    folder.rows("winners.csv").map((row) => [key_of(row, row.text("batch")), row]),
  );
  const by_set = grouped(
    [...agreement.values()],
    (row) => key_of(row, batch_of(row.text("algorithm"))),
  );
  const groups = grouped(times, (row) => key_of(row, batch_of(row.text("algorithm"))));
  const inputs = [...groups].map(([key, rows]): Input => {
    const row = rows[0]!;
    const entries = entries_of(rows, ratios, agreement, approximate);
    const [best, library = "", ratio = ""] = bests.get(key) ?? [];
    const suspect = rows.some((each) => ratios.get(label_key(each))?.text("suspect") === "1");
    const lead = lead_of(best, library, ratio, entries, suspect);
    const compared = lead === "ours" || lead === "libraries" || lead === "equal";
    const value = (end: string): number => (compared ? best!.number(`${ratio}${end}`) : NaN);
    const task = row.text("task");
    const batch = batch_of(row.text("algorithm"));
    return {
      key,
      question:
        (cells ? "How long does a query take?" : (questions[task] ?? task)) +
        (batch === "" ? "" : batch === "1" ? " One pair a call" : ` ${batch} pairs a call`),
      line: "",
      name: "",
      scene: cells ? row.text("group") : row.text("scene"),
      bodies: row.text("bodies"),
      kind: cells ? row.text("cell") : [row.text("pair_kind"), variant_of(row)].filter(Boolean).join(", "),
      threads: row.text("threads"),
      entries,
      graded: graded_of(rows, by_set.get(key) ?? [], agreement, approximate),
      lead,
      ours: best?.text("ours") ?? "",
      library: best?.text(library) ?? "",
      ratio: value(""),
      low: value("_low"),
      high: value("_high"),
      first: winners.get(key) ?? null,
    };
  });
  const usable = inputs.filter(({ entries }) => entries.length > 0);
  const alone = whole_scenes(usable);
  for (const input of usable) input.line = alone.includes(input.scene) ? input.scene : input.question;
  for (const [line, own] of grouped(usable, (input) => input.line)) {
    for (const input of own) input.name = short_name(input, own, !alone.includes(line));
  }
  const rank = ({ lead, line }: Input): number => (lead === "no library" ? 2 : alone.includes(line) ? 0 : 1);
  usable.sort((a, b) => rank(a) - rank(b));
  made.set(folder, usable);
  return usable;
}

// Scenes with times of broad and of narrow phases. The summary has a line for each of the first four.
function whole_scenes(inputs: Input[]): string[] {
  const has = (scene: string, narrow: boolean): boolean =>
    inputs.some((input) => input.scene === scene && (input.entries[0]!.row.text("task") !== "") === narrow);
  const scenes = distinct(inputs.map(({ scene }) => scene));
  return scenes.filter((scene) => scene !== "" && has(scene, true) && has(scene, false)).slice(0, 4);
}

// An input is named by what differs among the inputs of its line.
function short_name(input: Input, all: Input[], of_question: boolean): string {
  const differs = (value: (input: Input) => string): boolean => distinct(all.map(value)).length > 1;
  // A scene that has one number of bodies needs none in its name.
  const counts = [...grouped(all, ({ scene }) => scene).values()].some(
    (own) => distinct(own.map(({ bodies }) => bodies)).length > 1,
  );
  const { scene, bodies, kind, threads, question } = input;
  const parts = [
    differs((each) => each.scene) ? scene : "",
    counts && bodies ? count_text(Number(bodies)) : "",
    of_question ? "" : question.replace("?", ""),
    differs((each) => each.kind) || !of_question ? kind : "",
    differs((each) => each.threads) && threads !== "1" ? `${threads} threads` : "",
  ];
  return parts.filter(Boolean).join(", ") || kind || scene || question;
}

// How often each side leads, in words.
export function leads_text(inputs: Input[]): string {
  const count = (...leads: Lead[]): number => inputs.filter(({ lead }) => leads.includes(lead)).length;
  const compared = inputs.length - count("no library");
  if (compared === 0) return "no library to compare with";
  const told: [number, string][] = [
    [count("libraries"), "libraries in"],
    [count("equal"), "equal in"],
    [count("unclear"), "unclear in"],
    [count("no library is right"), "no library is right in"],
    [count("none of ours is right"), "none of ours is right in"],
  ];
  const others = told.filter(([number]) => number > 0).map(([number, words]) => `, ${words} ${number}`);
  return `ours faster in ${count("ours")} of ${compared}${others.join("")}`;
}

// More samples were disturbed than not: such times say nothing.
export function is_too_noisy(inputs: Input[]): boolean {
  const sum = (column: string): number =>
    inputs.flatMap(({ entries }) => entries).reduce((all, { row }) => all + (row.number(column) || 0), 0);
  return 2 * sum("noisy") > sum("samples");
}

// The geometric mean of what an algorithm takes over the fastest, in the inputs that it was asked about.
export interface Standing {
  algorithm: string;
  origin: string;
  relative: number;
  low: number; // NaN without an interval
  high: number;
  inputs: number;
  fault: Fault | null; // the worst
  faults: number; // inputs
  entries: Entry[];
}

const worst_first: Fault["kind"][] = ["failed", "wrong", "inexact", "by design"];

export function standings(entries: Entry[]): Standing[] {
  const of_each = grouped(entries, ({ algorithm }) => algorithm);
  const standing = ([algorithm, own]: [string, Entry[]]): Standing => {
    const n = own.length;
    const sum = (value: (entry: Entry) => number): number => own.reduce((all, each) => all + value(each), 0);
    const middle = sum((each) => Math.log(each.relative)) / n;
    // The errors of the inputs are taken as independent, as in the summary.
    const spread = (end: "low" | "high"): number =>
      Math.sqrt(sum((each) => Math.log(each[end] / each.relative) ** 2)) / n;
    const faults = own.map(({ fault }) => fault).filter((fault) => fault !== null);
    faults.sort((a, b) => worst_first.indexOf(a.kind) - worst_first.indexOf(b.kind));
    return {
      algorithm,
      origin: own[0]!.origin,
      relative: Math.exp(middle),
      low: Math.exp(middle - spread("low")),
      high: Math.exp(middle + spread("high")),
      inputs: n,
      fault: faults[0] ?? null,
      faults: faults.length,
      entries: own,
    };
  };
  return [...of_each].map(standing).sort((a, b) => a.relative - b.relative);
}

// Who is wrong, libraries first.
export function faults_text(inputs: Input[]): string[] {
  const entries = inputs.flatMap(({ graded }) => graded);
  const most_names = 3;
  const told = (title: string, belongs: (origin: string) => boolean): string => {
    const own = entries.filter(({ origin }) => belongs(origin));
    const names = (kind: Fault["kind"]): string => {
      const faulty = own.filter(({ fault }) => fault?.kind === kind);
      const name = ({ algorithm }: Graded): string => algorithm.replace(/ (double|float)\b.*$/, "");
      const each = [...grouped(faulty, name)].map(([algorithm, of]) => {
        const wrong = of.reduce((sum, { fault }) => sum + fault!.wrong, 0);
        const queries = of.reduce((sum, { fault }) => sum + fault!.queries, 0);
        return wrong > 0 && queries > 0
          ? `${algorithm} (${count_text(wrong)} of ${count_text(queries)} answers)`
          : algorithm;
      });
      const more = each.length - most_names;
      return each.slice(0, most_names).join(", ") + (more > 0 ? ` and ${more} more` : "");
    };
    const kinds: Record<Fault["kind"], string> = {
      wrong: "wrong",
      failed: "failed",
      inexact: "inexact numbers",
      "by design": "approximate by design",
    };
    const sentences = (Object.keys(kinds) as Fault["kind"][])
      .map((kind) => [kinds[kind], names(kind)])
      .filter(([, list]) => list !== "")
      .map(([kind, list]) => `${kind}: ${list}`);
    return `${title}: ${sentences.join("; ") || "all right"}.`;
  };
  return [
    entries.some(({ origin }) => is_library(origin)) ? told("Libraries", is_library) : "",
    entries.some(({ origin }) => is_ours(origin)) ? told("Ours", is_ours) : "",
  ].filter(Boolean);
}

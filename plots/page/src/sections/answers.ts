// A few sentences say what came out of a results folder.
import { count_text, number_text, time_interval, time_text } from "../base/numbers";
import type { Folder } from "../tables/folder";
import { distinct, set_key } from "../tables/set";
import type { Row } from "../tables/table";

const total = (rows: Row[], column: string): number =>
  rows.reduce((sum, row) => sum + (row.number(column) || 0), 0);

export function answers(folder: Folder, origins: Record<string, string>, approximate: string[] = []): string[] {
  const lines = [
    ...timed(folder),
    ...agreed(folder, approximate),
    ...checked(folder, origins),
    ...versioned(folder),
    ...swept(folder),
    ...soaked(folder),
    ...traded(folder),
  ];
  if (folder.fact("finished") === "no") lines.push("The run did not come to its end.");
  return lines.length > 0 ? lines : ["The folder has no rows to sum up."];
}

function timed(folder: Folder): string[] {
  const times = [...folder.rows("times.csv"), ...folder.rows("set_times.csv")];
  if (times.length === 0) return [];
  const sets = distinct(times.map((row) => set_key(row))).length;
  const algorithms = distinct(times.map((row) => row.text("algorithm"))).length;
  const samples = total(times, "samples");
  const disturbed = (100 * total(times, "noisy")) / Math.max(samples, 1);
  return [
    `${algorithms} algorithms were timed on ${sets} inputs, in ${count_text(samples)} samples; ` +
      `${number_text(disturbed)} % of them were dropped because other programs ran.`,
  ];
}

// What is approximate by design is counted apart, as in the summary.
function agreed(folder: Folder, approximate: string[]): string[] {
  const all = folder.rows("agreement.csv");
  return [
    { origin: "ours", who: "Ours" },
    { origin: "peer", who: "The libraries" },
  ].flatMap(({ origin, who }) => {
    const rows = all.filter((row) => row.text("origin") === origin);
    if (rows.length === 0) return [];
    const name = (row: Row): string => row.text("algorithm").split(" ")[0] ?? "";
    const loose = rows.filter((row) => approximate.includes(name(row)) && row.number("wrong") > 0);
    const by_design = total(loose, "wrong");
    return [
      `${who} answered ${count_text(total(rows, "queries"))} queries: ` +
        `${count_text(total(rows, "wrong") - by_design)} on the wrong side of contact, ` +
        `${count_text(total(rows, "failed"))} gave up, ${count_text(total(rows, "unanswered"))} without an answer.` +
        (by_design > 0
          ? ` Of ${distinct(loose.map(name)).join(", ")}, approximate by design, ${count_text(by_design)} more on the wrong side.`
          : ""),
    ];
  });
}

// The sentence names the three algorithms with the most silent errors.
function most_silent(rows: Row[]): string {
  const counts = distinct(rows.map((row) => row.text("algorithm")))
    .map((algorithm): [string, number] => [
      algorithm,
      total(
        rows.filter((row) => row.text("algorithm") === algorithm),
        "silent",
      ),
    ])
    .filter(([, count]) => count > 0)
    .sort(([, a], [, b]) => b - a);
  if (counts.length === 0) return "";
  const named = counts.slice(0, 3).map(([name, count]) => `${name} ${count_text(count)}`);
  return ` (${named.join(", ")}${counts.length > 3 ? ", ..." : ""})`;
}

function checked(folder: Folder, origins: Record<string, string>): string[] {
  const subjects = { ours: "ours", peer: "the libraries" };
  return Object.entries(subjects).flatMap(([origin, subject]) => {
    const rows = folder
      .rows("summary.csv")
      .filter((row) => origins[row.text("algorithm")] === origin);
    if (rows.length === 0) return [];
    return [
      `${count_text(total(rows, "answers"))} answers of ${subject} were graded against exact arithmetic: ` +
        `${count_text(total(rows, "silent"))} are silently on the wrong side of contact${most_silent(rows)}, ` +
        `${count_text(total(rows, "honest"))} gave up, ` +
        `${count_text(total(rows, "crashed"))} crashed.`,
    ];
  });
}

function versioned(folder: Folder): string[] {
  const rows = folder.rows("versions.csv");
  if (rows.length === 0) return [];
  const libraries = distinct(rows.map((row) => row.text("library"))).length;
  const versions = distinct(rows.map((row) => row.text("algorithm")));
  const wrong = versions.filter((name) => total(rows.filter((row) => row.text("algorithm") === name), "wrong") > 0);
  return [
    `${versions.length} versions of ${libraries} libraries gave ${count_text(total(rows, "answers"))} answers; ` +
      `${count_text(total(rows, "wrong"))} are wrong, of ${wrong.length} versions.`,
  ];
}

function swept(folder: Folder): string[] {
  const rows = folder.rows("envelope.csv");
  if (rows.length === 0) return [];
  const silent = (origin: string): string => {
    const of_origin = rows.filter((row) => row.text("origin") === origin);
    return `${count_text(total(of_origin, "silent"))} of ${count_text(total(of_origin, "answers"))}`;
  };
  return [
    `Along ${distinct(rows.map((row) => row.text("axis"))).length} axes towards hard input ${silent("ours")} answers of ours ` +
      `are silently wrong, and ${silent("peer")} of the libraries'.`,
  ];
}

function soaked(folder: Folder): string[] {
  const rows = folder.rows("soak.csv");
  if (rows.length === 0) return [];
  return [
    `In a soak ${count_text(total(rows, "pairs"))} verdicts were compared with exact ones: ` +
      `${count_text(total(rows, "silent"))} silently wrong, ${count_text(total(rows, "lost"))} failed.`,
  ];
}

function traded(folder: Folder): string[] {
  const points = folder.rows("points.csv"),
    front = folder.rows("front.csv");
  if (points.length === 0) return [];
  const told = (row: Row): string =>
    `${time_text(row.number("seconds"))} (${time_interval(row)}) a frame at an error of ${number_text(row.number("error"))}`;
  const ends = [front[0], front[front.length - 1]].filter((row) => row !== undefined);
  return [
    `${points.length} configurations were played, ${front.length} are on the front` +
      (ends.length === 2 ? `: from ${told(ends[0]!)} to ${told(ends[1]!)}.` : "."),
  ];
}

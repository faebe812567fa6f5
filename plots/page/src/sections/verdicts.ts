// This section shows who is right and who is wrong, in a campaign, a check, a sweep and a soak.
import { choice, chosen_chart, controls } from "../base/controls";
import { make, quiet } from "../base/dom";
import { part, section } from "../base/section";
import { outcome_legend, stress_map } from "../charts/stress_map";
import { case_list } from "../scene/case_list";
import type { Folder } from "../tables/folder";
import { redraw } from "../tables/grid";
import { distinct } from "../tables/set";
import type { Row } from "../tables/table";

export function verdicts(folder: Folder): HTMLElement | null {
  const parts = [
    agreement(folder),
    departures(folder),
    grades(folder),
    sweep(folder),
    soak(folder),
  ];
  if (folder.pairs.length > 0) {
    parts.push(part(`${folder.anchor}-pairs`, "The pairs themselves", case_list(folder)));
  }
  const shown = parts.filter((each) => each !== null);
  return shown.length > 0 ? section(`${folder.name}: right and wrong`, ...shown) : null;
}

// A reader may look for errors of at least these sizes.
const error_sizes = ["", "1e-15", "1e-12", "1e-9", "1e-6", "1e-3", "1e-1"];

// Above a file's table stand choosers: one for each column of names, and one for the greatest error.
function filtered(
  folder: Folder,
  file: string,
  names: string[],
  errors: string[],
  lead: string[],
): HTMLElement[] {
  const rows = folder.rows(file);
  const wanted = new Map<string, string>();
  let at_least = 0;
  const worst = (row: Row): number =>
    errors.reduce((most, column) => Math.max(most, Math.abs(row.number(column)) || 0), 0);
  const table = folder.grid(file, {
    lead,
    keep: (row) =>
      [...wanted].every(([column, value]) => value === "" || row.text(column) === value) &&
      (at_least === 0 || worst(row) >= at_least),
    link: (row) =>
      folder.case_of_algorithm(row.text("algorithm"), row.text("scalar"), row.text("task")),
  });
  const choosers = names.map((column) => {
    const options = ["", ...distinct(rows.map((row) => row.text(column))).filter(Boolean)];
    return choice(column.replaceAll("_", " "), options, 0, (place) => {
      wanted.set(column, options[place]!);
      redraw(table);
    });
  });
  const by_size = choice("errors of at least", error_sizes, 0, (place) => {
    at_least = Number(error_sizes[place]);
    redraw(table);
  });
  return [controls(...choosers, by_size), table];
}

function agreement(folder: Folder): HTMLElement | null {
  if (!folder.has("agreement.csv")) return null;
  return part(
    `${folder.anchor}-answers`,
    "Answers against the exact ones",
    quiet("Right and wrong are sides of contact. Errors are parts of the pair's size."),
    ...filtered(
      folder,
      "agreement.csv",
      ["scene", "task", "pair_kind", "origin"],
      ["worst_error"],
      [
        "scene",
        "task",
        "pair_kind",
        "algorithm",
        "origin",
        "queries",
        "right",
        "wrong",
        "failed",
        "worst_error",
      ],
    ),
  );
}

function departures(folder: Folder): HTMLElement | null {
  if (!folder.has("departures.csv")) return null;
  return part(
    `${folder.anchor}-wrong`,
    "Departures",
    quiet("3D leads to the pair."),
    folder.grid("departures.csv", {
      lead: ["algorithm", "where", "what"],
      link: (row) => folder.case_of_file(row.text("reproduction")),
    }),
  );
}

function grades(folder: Folder): HTMLElement | null {
  if (!folder.has("summary.csv")) return null;
  return part(
    `${folder.anchor}-grades`,
    "Grades by regime",
    quiet(
      "Errors are parts of the pair's size, or of its distance if that is greater. 3D leads to a pair that the algorithm gets wrong.",
    ),
    ...filtered(
      folder,
      "summary.csv",
      ["group", "regime", "algorithm", "scalar"],
      ["margin", "distance", "too_deep", "too_shallow", "does_not_separate", "excess", "witness"],
      [
        "algorithm",
        "scalar",
        "regime",
        "group",
        "answers",
        "silent",
        "honest",
        "margin",
        "distance",
      ],
    ),
  );
}

function sweep(folder: Folder): HTMLElement | null {
  if (!folder.has("stress.csv")) return null;
  const rows = folder.rows("stress.csv");
  const axes = distinct(rows.map((row) => row.text("axis")));
  return part(
    `${folder.anchor}-breaks`,
    "Where algorithms break",
    quiet(outcome_legend),
    ...chosen_chart("Axis", axes, (place) => stress_map(rows, axes[place]!)),
    ...filtered(
      folder,
      "envelope.csv",
      ["axis", "algorithm", "scalar", "origin"],
      ["worst_error", "worst_margin"],
      [],
    ),
    make("h4", {}, "All cells of the sweep"),
    ...filtered(
      folder,
      "stress.csv",
      ["axis", "algorithm", "scalar", "task"],
      ["worst_error", "worst_margin"],
      [],
    ),
  );
}

function soak(folder: Folder): HTMLElement | null {
  if (!folder.has("soak.csv")) return null;
  return part(`${folder.anchor}-millions`, "Verdicts by the million", folder.grid("soak.csv"));
}

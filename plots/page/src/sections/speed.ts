// This section shows times: curves against count, who leads in each set, phases, speed-up, and the samples of a row.
import { quiet, make } from "../base/dom";
import { part, section } from "../base/section";
import { time_against_count } from "../charts/curves";
import { phases } from "../charts/phases";
import { samples_of } from "../charts/samples";
import { speed_up } from "../charts/speed_up";
import { winners } from "../charts/winners";
import type { Folder } from "../tables/folder";
import type { Row } from "../tables/table";

export function speed(folder: Folder): HTMLElement | null {
  // A folder has the times of scenes, or of sets of queries.
  const times = folder.has("times.csv") ? "times.csv" : "set_times.csv";
  if (!folder.has(times)) return null;
  const samples = make("div", { id: `${folder.anchor}-samples`, "aria-live": "polite" });
  const sampled = folder.files.includes("raw.csv");
  const pick = (row: Row): void => {
    if (!sampled) return;
    samples.replaceChildren(samples_of(folder, row));
    samples.scrollIntoView({ block: "nearest" });
  };
  const hint = sampled
    ? " Click a row or a point, or press Enter on a row, to see its samples."
    : "";
  return section(
    `${folder.name}: speed`,
    time_against_count(folder, pick),
    winners(folder),
    phases(folder),
    speed_up(folder),
    part(
      `${folder.anchor}-times-part`,
      "Times of all sets",
      quiet(`Medians with 95 % intervals.${hint}`),
      samples,
      folder.grid(times, {
        lead: [
          "group",
          "cell",
          "scene",
          "bodies",
          "threads",
          "task",
          "pair_kind",
          "algorithm",
          "origin",
          "seconds",
          "seconds_low",
          "seconds_high",
        ],
        picked: sampled ? pick : undefined,
      }),
    ),
  );
}

// This section shows several results side by side: each algorithm's time over that of the baseline of the same
// folder. Times of two machines are never divided by each other.
import { chosen_chart } from "../base/controls";
import { make, quiet } from "../base/dom";
import { part, section } from "../base/section";
import { ratio_chart } from "../charts/ratios";
import type { Folder } from "../tables/folder";
import { grid } from "../tables/grid";
import { distinct, grouped, set_key, set_text } from "../tables/set";
import { Table, type Row } from "../tables/table";

interface Measured {
  folder: string;
  row: Row;
}

export function compare(folders: Folder[]): HTMLElement | null {
  const timed = folders.filter((folder) => folder.has("ratios.csv"));
  if (timed.length < 2) return null;
  const all = timed.flatMap((folder) =>
    folder
      .rows("ratios.csv")
      .filter((row) => row.text("canary") !== "1" && row.number("ratio") > 0)
      .map((row): Measured => ({ folder: folder.name, row })),
  );
  const shared = [
    ...grouped(all, ({ row }) => JSON.stringify([set_key(row), row.text("baseline")])).values(),
  ].filter((group) => distinct(group.map((each) => each.folder)).length > 1);
  return section(
    "Comparison",
    quiet(
      "A ratio is a time over that of the baseline in the same rounds. Times of two folders are never divided, because machines differ.",
    ),
    part("comparison-machines", "What differs between the folders", differences(timed)),
    shared.length > 0
      ? ratios(
          shared,
          timed.map((folder) => folder.name),
        )
      : make(
          "p",
          {},
          "The folders share no input with the same baseline.",
        ),
  );
}

// The table shows the facts of machine.csv that are not the same everywhere, and always those that name the results.
function differences(folders: Folder[]): HTMLElement {
  const always = ["processor", "commit"];
  const names = distinct([
    ...always,
    ...folders.flatMap((folder) => folder.rows("machine.csv").map((row) => row.text("name"))),
  ]);
  const rows = names
    .map((name) => [name, ...folders.map((folder) => folder.fact(name))])
    .filter(
      ([name, ...values]) =>
        always.includes(name!) || (distinct(values).length > 1 && !name!.startsWith("scene ")),
    );
  return grid(Table.of(["fact", ...folders.map((folder) => folder.name)], rows));
}

function ratios(shared: Measured[][], folders: string[]): HTMLElement {
  const titles = shared.map(
    (group) => `${set_text(group[0]!.row)}, over ${group[0]!.row.text("baseline")}`,
  );
  const chart = (place: number): Element => {
    const values = shared[place]!.map(({ folder, row }) => ({
      folder,
      algorithm: row.text("algorithm"),
      ratio: row.number("ratio"),
      low: row.number("ratio_low"),
      high: row.number("ratio_high"),
    }));
    return ratio_chart(values, folders, shared[place]![0]!.row.text("baseline"));
  };
  return part(
    "comparison-ratios",
    "Ratios within each folder",
    ...chosen_chart("Set", titles, chart),
    ratio_table(shared, folders),
  );
}

// Two intervals are apart if they have no number in common. Nobody knows where one is missing.
function are_apart(rows: Row[]): string {
  if (rows.length < 2) return "";
  const low = Math.max(...rows.map((row) => row.number("ratio_low")));
  const high = Math.min(...rows.map((row) => row.number("ratio_high")));
  if (Number.isNaN(low) || Number.isNaN(high)) return "";
  return low > high ? "yes" : "no";
}

function ratio_table(shared: Measured[][], folders: string[]): HTMLElement {
  const columns = ["set", "baseline", "algorithm", "intervals apart"];
  for (const name of folders) columns.push(name, `${name}: low`, `${name}: high`);
  const lines = shared.flatMap((group) =>
    [...grouped(group, ({ row }) => row.text("algorithm"))].map(([algorithm, measured]) => {
      const fields = folders.flatMap((name) => {
        const row = measured.find((each) => each.folder === name)?.row;
        return ["ratio", "ratio_low", "ratio_high"].map((column) => row?.text(column) ?? "");
      });
      const { row } = measured[0]!;
      return [
        set_text(row),
        row.text("baseline"),
        algorithm,
        are_apart(measured.map((each) => each.row)),
        ...fields,
      ];
    }),
  );
  return grid(Table.of(columns, lines));
}

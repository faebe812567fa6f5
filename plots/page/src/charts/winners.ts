// The heat map has a cell for each set. It shows the fastest algorithm, and by how much it leads.
import * as Plot from "@observablehq/plot";
import { make, quiet } from "../base/dom";
import { interval_text, number_text } from "../base/numbers";
import { part } from "../base/section";
import type { Folder } from "../tables/folder";
import { distinct, grouped, set_text } from "../tables/set";
import type { Row } from "../tables/table";

interface Cell {
  across: string;
  down: string;
  winner: string;
  lead: number;
  tip: string;
}

function cell_of(row: Row): Cell {
  const winner = row.text("winner"),
    lead = row.number("ratio");
  const interval = interval_text(row.number("ratio_low"), row.number("ratio_high"));
  const suspect =
    row.text("suspect") === "1" ? "\nsuspect: the baseline differs from its twin" : "";
  return {
    across: row.text("pair_kind") || row.text("bodies") || "all",
    down: set_text(row, row.text("pair_kind") ? ["pair_kind"] : ["bodies"]),
    winner,
    lead: lead > 0 && Number.isFinite(lead) ? lead : 1,
    tip: `${winner}\nis ${number_text(lead)} times as fast as ${row.text("runner_up")}\n(${interval})${suspect}`,
  };
}

function heat_map(rows: Row[]): Element {
  const cells = rows.map(cell_of);
  const across = distinct(cells.map((each) => each.across)).sort((a, b) =>
    a.localeCompare(b, "en", { numeric: true }),
  );
  const down = distinct(cells.map((each) => each.down));
  return Plot.plot({
    width: Math.max(700, 400 + across.length * 140),
    height: 60 + down.length * 36,
    marginLeft: 400,
    ariaLabel: "the fastest algorithm of each set",
    x: { domain: across, label: null, axis: "top" },
    y: { domain: down, label: null },
    // The scale ends at a lead of eight, since more is dark all the same.
    color: { type: "log", scheme: "blues", domain: [0.7, 8], clamp: true },
    marks: [
      Plot.cell(cells, { x: "across", y: "down", fill: "lead", inset: 1 }),
      Plot.text(cells, {
        x: "across",
        y: "down",
        text: (each: Cell) => `${each.winner}\n× ${number_text(each.lead)}`,
        fontSize: 10,
        // Both letters have a contrast of at least 4.5 to 1 at a lead of four.
        fill: (each: Cell) => (each.lead > 4 ? "white" : "black"),
      }),
      Plot.tip(cells, Plot.pointer({ x: "across", y: "down", title: "tip" })),
    ],
  });
}

export function winners(folder: Folder): HTMLElement | null {
  if (!folder.has("winners.csv")) return null;
  // Broad phases stand by their numbers of bodies, narrow phases by the kinds of shapes.
  const kinds = grouped(folder.rows("winners.csv"), (row) =>
    row.text("pair_kind") ? "kinds" : "bodies",
  );
  return part(
    `${folder.anchor}-fastest`,
    "The fastest of each set",
    quiet(
      "A cell names the fastest that answers right, and how many times the next one's time is its own. Darker is a greater lead.",
    ),
    ...[...kinds.values()].map((rows) => make("figure", { class: "scroll" }, heat_map(rows))),
    folder.grid("winners.csv", {
      lead: ["scene", "bodies", "task", "pair_kind", "winner", "runner_up", "ratio"],
    }),
  );
}

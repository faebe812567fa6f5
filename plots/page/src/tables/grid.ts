// A grid is a table that sorts by its headings and filters by a text. It shows a part of a long table at a time,
// so that a hundred thousand rows do no harm; the filter looks at all of them.
import { answer_for } from "../base/anchors";
import { button } from "../base/controls";
import { make } from "../base/dom";
import { count_text } from "../base/numbers";
import { pickable_rows } from "./picking";
import { numeric_columns, selected_rows, type Order } from "./selection";
import type { Row, Table } from "./table";

export interface GridOptions {
  lead?: string[]; // columns that come first, where the file has them
  link?: (row: Row) => string | undefined; // the address of the pair that a row is about
  link_text?: string;
  picked?: (row: Row) => void; // called when a row is picked, by mouse or by keyboard
  keep?: (row: Row) => boolean; // a filter that the reader sets beside the table
}

interface Placed extends GridOptions {
  file?: string;
  folder?: string;
  anchor?: string; // rows are #anchor-row-N, fields #anchor-row-N-column
}

const rows_at_a_time = 200;

// A grid whose filter may change has a way to draw it again.
const redraws = new WeakMap<HTMLElement, () => void>();
export const redraw = (grid: HTMLElement): void => redraws.get(grid)?.();

export const grid = (table: Table, options: GridOptions = {}): HTMLElement =>
  file_grid(table, options);

export function file_grid(table: Table, options: Placed): HTMLElement {
  const lead = (options.lead ?? [])
    .map((name) => table.columns.indexOf(name))
    .filter((i) => i >= 0);
  const columns = [...lead, ...table.columns.keys()].filter((i, k, all) => all.indexOf(i) === k);
  const numeric = numeric_columns(table);
  const order: Order = { column: -1, down: false };
  let wanted = "",
    shown = rows_at_a_time;
  let rows: Row[] = [];

  const body = make("tbody");
  const heads = make("tr", {}, make("td", {}));
  const listing = make(
    "table",
    { "data-file": options.file, "data-folder": options.folder },
    make("thead", {}, heads),
    body,
  );
  const { picked } = options;
  const picking = picked
    ? pickable_rows(listing, body, (row) => picked(rows[row.sectionRowIndex]!))
    : null;
  const count = make("p", { class: "count", "aria-live": "polite" });
  const more = button("Show more", () => extend(shown + rows_at_a_time));
  const all = button("Show all", () => extend(rows.length));
  const headings = columns.map((column) => heading(column));
  heads.append(...headings);

  function heading(column: number): HTMLElement {
    const name = table.columns[column]!;
    const sort = button(name.replaceAll("_", " "), () => {
      order.down = order.column === column && !order.down;
      order.column = column;
      for (const other of headings) other.setAttribute("aria-sort", "none");
      element.setAttribute("aria-sort", order.down ? "descending" : "ascending");
      draw();
    });
    sort.classList.add("sort");
    const element = make("th", { scope: "col", "aria-sort": "none", "data-column": name }, sort);
    if (numeric.has(column)) element.classList.add("number");
    return element;
  }

  function draw(): void {
    rows = selected_rows(table, order, wanted, options.keep);
    shown = rows_at_a_time;
    body.replaceChildren();
    extend(shown);
  }

  function extend(to: number): void {
    shown = Math.max(to, rows_at_a_time);
    for (const row of rows.slice(body.rows.length, shown)) {
      const element = row_element(row);
      body.append(element);
      picking?.join(element);
    }
    count.textContent =
      `${count_text(body.rows.length)} of ${count_text(rows.length)} rows` +
      (rows.length < table.rows.length ? ` that match, of ${count_text(table.rows.length)}` : "");
    more.hidden = all.hidden = rows.length <= shown;
  }

  function row_element(row: Row): HTMLTableRowElement {
    const anchor = options.anchor ? `${options.anchor}-row-${row.index}` : undefined;
    const about = options.link?.(row);
    const head = make("th", { scope: "row" });
    if (anchor) head.append(make("a", { href: `#${anchor}`, class: "link" }, String(row.index)));
    if (about) head.append(" ", make("a", { href: `#${about}` }, options.link_text ?? "3D"));
    const cells = columns.map((column) =>
      make(
        "td",
        { class: numeric.has(column) ? "number" : undefined },
        table.field(row.index, column),
      ),
    );
    const element = make("tr", { id: anchor }, head, ...cells);
    return element;
  }

  // An address may name a row that is hidden. It is shown, whatever hides it.
  function show_row(rest: string): Element | null {
    const named = /^row-(\d+)(?:-(.+))?$/.exec(rest);
    const row = named ? table.rows[Number(named[1])] : undefined;
    if (!row) return null;
    if (!rows.includes(row)) {
      wanted = filter.value = "";
      draw();
    }
    extend(Math.max(shown, rows.indexOf(row) + 1));
    const element = document.getElementById(`${options.anchor}-row-${row.index}`);
    const column = columns.indexOf(table.columns.indexOf(named![2] ?? ""));
    return (element instanceof HTMLTableRowElement && element.cells[column + 1]) || element;
  }

  const filter = make("input", {
    type: "search",
    placeholder: "filter",
    "aria-label": "filter the table",
  });
  filter.addEventListener("input", () => {
    wanted = filter.value;
    draw();
  });
  draw();
  if (options.anchor) answer_for(options.anchor, show_row);
  const element = make(
    "div",
    { class: "grid", id: options.anchor },
    table.cut
      ? make("p", { class: "wrong" }, "The file ends within a row, which is left out.")
      : null,
    filter,
    count,
    make(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": options.file ?? "table" },
      listing,
    ),
    more,
    " ",
    all,
  );
  redraws.set(element, draw);
  return element;
}

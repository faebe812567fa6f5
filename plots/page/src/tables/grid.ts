// A grid is a table that sorts by its headings and filters by a text. It shows a part of a long table at a time,
// so that a hundred thousand rows do no harm; the filter looks at all of them. Numbers have three digits, and hashes and
// columns that say nothing are left out, until the reader asks for the file as it stands.
import { answer_for } from "../base/anchors";
import { button, checkbox, controls } from "../base/controls";
import { make, quiet } from "../base/dom";
import { count_text, field_text } from "../base/numbers";
import { Slices } from "../base/slices";
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

// These have seconds. Others than the last are those of times.csv.
const is_time = (column: string, file?: string): boolean =>
  /(^|_)seconds(_low|_high)?$/.test(column) ||
  column === "worst_frame" ||
  (file === "times.csv" &&
    ["minimum", "build", "update", "find_pairs", "narrow", "convert"].includes(column));

// A grid whose filter may change has a way to draw it again.
const redraws = new WeakMap<HTMLElement, () => void>();
export const redraw = (grid: HTMLElement): void => redraws.get(grid)?.();

export const grid = (table: Table, options: GridOptions = {}): HTMLElement =>
  file_grid(table, options);

export function file_grid(table: Table, options: Placed): HTMLElement {
  const lead = (options.lead ?? [])
    .map((name) => table.columns.indexOf(name))
    .filter((i) => i >= 0);
  const all_columns = [...lead, ...table.columns.keys()].filter(
    (i, k, all) => all.indexOf(i) === k,
  );
  // A reader of a file with several rows learns from one sentence what is the same in all of them.
  const constant = new Set(
    options.file && table.rows.length > 1
      ? all_columns.filter((column) => table.is_constant(column))
      : [],
  );
  if (constant.size === all_columns.length) constant.clear();
  const is_hash = (column: number): boolean => /(^|_)hash$/.test(table.columns[column]!);
  // Both ends of an interval stand behind the number that it is of.
  const ends = new Map<number, [number, number]>();
  for (const column of all_columns) {
    if (constant.has(column)) continue;
    const [low, high] = ["low", "high"].map((end) => table.columns.indexOf(`${table.columns[column]}_${end}`));
    if (low! >= 0 && high! >= 0) ends.set(column, [low!, high!]);
  }
  const hidden = new Set([
    ...constant,
    ...(options.file ? all_columns.filter(is_hash) : []),
    ...[...ends.values()].flat(),
  ]);
  const telling = all_columns.filter((column) => !hidden.has(column));
  let as_in_file = false,
    columns = telling;
  const times = new Set(
    all_columns.filter((column) => is_time(table.columns[column]!, options.file)),
  );
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
  const all = button("Show all", () => void show_all());
  let headings: HTMLElement[] = [];
  const whole = checkbox("as in the file", false, (on) => set_whole(on));
  function set_whole(on: boolean): void {
    as_in_file = on;
    whole.set(on);
    columns = on ? all_columns : telling;
    headings = columns.map((column) => heading(column));
    heads.replaceChildren(heads.cells[0]!, ...headings);
    same.hidden = on;
    const kept = shown;
    draw();
    extend(kept);
  }
  const same = quiet(
    same_text(
      table,
      [...constant].filter((column) => !is_hash(column)),
    ),
  );

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
    const sorted = order.column !== column ? "none" : order.down ? "descending" : "ascending";
    const element = make("th", { scope: "col", "aria-sort": sorted, "data-column": name }, sort);
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
    tell();
  }

  // Rows are made in slices, and laid out once.
  async function show_all(): Promise<void> {
    const wanted_rows = rows,
      wanted_columns = columns,
      from = body.rows.length;
    const slices = new Slices((text) => (count.textContent = text));
    const made = document.createDocumentFragment();
    await slices.begin("showing all rows");
    for (let place = from; place < wanted_rows.length; ++place) {
      const element = row_element(wanted_rows[place]!);
      made.append(element);
      picking?.join(element);
      await slices.rest(place, wanted_rows.length);
    }
    // The reader may have asked for something else meanwhile.
    if (rows !== wanted_rows || columns !== wanted_columns || body.rows.length !== from) return tell();
    body.append(made);
    shown = rows.length;
    tell();
  }

  function tell(): void {
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
    const cells = columns.map((column) => {
      const text = table.field(row.index, column);
      if (!numeric.has(column)) return make("td", {}, text);
      const short = as_in_file ? text : field_text(text, times.has(column));
      return make("td", { class: "number", title: short === text ? undefined : text }, short, interval(row, column));
    });
    const element = make("tr", { id: anchor }, head, ...cells);
    return element;
  }

  function interval(row: Row, column: number): HTMLElement | null {
    const [low, high] = (ends.get(column) ?? []).map((end) => table.field(row.index, end));
    if (as_in_file || !low || !high) return null;
    const [short_low, short_high] = [low, high].map((text) => field_text(text, times.has(column)));
    return make("small", { title: `${low} to ${high}` }, ` (${short_low} to ${short_high})`);
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
    if (hidden.has(table.columns.indexOf(named![2] ?? ""))) set_whole(true);
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
  set_whole(false);
  if (options.anchor) answer_for(options.anchor, show_row);
  const element = make(
    "div",
    { class: "grid", id: options.anchor },
    table.cut
      ? make("p", { class: "wrong" }, "The file ends within a row, which is left out.")
      : null,
    controls(
      filter,
      options.file ? whole.element : null,
      options.file ? button("Download", () => download(options.file!, table.text)) : null,
    ),
    constant.size > 0 ? same : null,
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

function same_text(table: Table, constant: number[]): string {
  const named = (column: number): string => table.columns[column]!.replaceAll("_", " ");
  const empty = constant.filter((column) => table.field(0, column) === "");
  const same = constant.filter((column) => !empty.includes(column));
  const sentences: string[] = [];
  if (same.length > 0) {
    const texts = same.map((column) => `${named(column)} ${table.field(0, column)}`);
    sentences.push(`The same in all rows: ${texts.join(", ")}.`);
  }
  if (empty.length > 0) sentences.push(`Empty in all rows: ${empty.map(named).join(", ")}.`);
  return sentences.join(" ");
}

function download(name: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

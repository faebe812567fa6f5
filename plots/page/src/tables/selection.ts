// The filter and the order say which rows of a table are shown, and where.
import { is_number_text, number_of } from "../base/numbers";
import type { Row, Table } from "./table";

export interface Order {
  column: number; // -1 keeps the order of the file
  down: boolean;
}

// A column has numbers if some rows all over the table have them: to look at all rows would take too long.
export function numeric_columns(table: Table): Set<number> {
  const looked_at = 100;
  const step = Math.max(1, Math.floor(table.rows.length / looked_at));
  const numeric = new Set<number>();
  for (let column = 0; column < table.columns.length; ++column) {
    let numbers = 0,
      words = 0;
    for (let row = 0; row < table.rows.length; row += step) {
      const text = table.field(row, column);
      if (text === "") continue;
      if (is_number_text(text)) ++numbers;
      else ++words;
    }
    if (numbers > 0 && words === 0) numeric.add(column);
  }
  return numeric;
}

export function selected_rows(
  table: Table,
  order: Order,
  wanted: string,
  keep?: (row: Row) => boolean,
): Row[] {
  const words = wanted.toLowerCase().split(/\s+/).filter(Boolean);
  const rows = table.rows.filter((row) => {
    if (keep && !keep(row)) return false;
    if (words.length === 0) return true;
    const line = table.line(row.index).toLowerCase();
    return words.every((word) => line.includes(word));
  });
  return order.column < 0 ? rows : sorted(table, rows, order);
}

function sorted(table: Table, rows: Row[], { column, down }: Order): Row[] {
  const texts = rows.map((row) => table.field(row.index, column));
  const sign = down ? -1 : 1;
  const places = [...rows.keys()];
  if (texts.every((text) => text === "" || is_number_text(text))) {
    const numbers = Float64Array.from(texts, number_of);
    places.sort((a, b) => {
      const x = numbers[a]!,
        y = numbers[b]!;
      // A field without a number comes last either way.
      if (Number.isNaN(x) || Number.isNaN(y))
        return Number(Number.isNaN(x)) - Number(Number.isNaN(y));
      return x === y ? 0 : sign * (x < y ? -1 : 1);
    });
  } else {
    const { compare } = new Intl.Collator("en", { numeric: true });
    places.sort((a, b) => sign * compare(texts[a]!, texts[b]!));
  }
  return places.map((place) => rows[place]!);
}

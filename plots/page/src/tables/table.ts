// A table is a CSV file by rows and columns. The text stays as it is: a table knows where each field starts, so
// that a hundred thousand rows cost four bytes a field and no strings.
import { number_of } from "../base/numbers";

const quote = 34,
  comma = 44,
  newline = 10,
  carriage_return = 13;

export class Table {
  readonly columns: string[];
  readonly rows: Row[];
  // The last line of a killed run has no end, and its last number may be cut.
  readonly cut: boolean;
  private readonly place = new Map<string, number>();
  private readonly starts: Uint32Array;

  constructor(private readonly source: string) {
    const { starts, widths, cut } = fields_of(source);
    this.cut = cut;
    const width = widths[0] ?? 0;
    this.columns = [];
    for (let i = 0; i < width; ++i) {
      const name = this.field_at(starts[i]!, starts[i + 1]!);
      this.columns.push(name);
      if (!this.place.has(name)) this.place.set(name, i);
    }
    // Every row gets as many fields as there are columns. Those it lacks are empty.
    const count = Math.max(0, widths.length - 1);
    this.starts = new Uint32Array(count * (width + 1));
    let from = width + 1;
    for (let row = 0; row < count; ++row) {
      const own = widths[row + 1]!;
      for (let i = 0; i <= width; ++i) {
        this.starts[row * (width + 1) + i] = starts[from + Math.min(i, own)]!;
      }
      from += own + 1;
    }
    this.rows = Array.from({ length: count }, (_, index) => new Row(this, index));
  }

  // Some tables have texts that are not in a file.
  static of(columns: string[], rows: string[][]): Table {
    const field = (text: string): string => `"${text.replaceAll('"', '""')}"`;
    return new Table([columns, ...rows].map((row) => `${row.map(field).join(",")}\n`).join(""));
  }

  has(column: string): boolean {
    return this.place.has(column);
  }

  field(row: number, column: number): string {
    const at = row * (this.columns.length + 1) + column;
    return this.field_at(this.starts[at]!, this.starts[at + 1]!);
  }

  named(row: number, column: string): string {
    const place = this.place.get(column);
    return place === undefined ? "" : this.field(row, place);
  }

  // This is the whole file.
  get text(): string {
    return this.source;
  }

  // All rows have the same text in the column.
  is_constant(column: number): boolean {
    const width = this.columns.length + 1;
    const first = this.starts[column] ?? 0;
    const length = (this.starts[column + 1] ?? 0) - first;
    for (let row = 1; row < this.rows.length; ++row) {
      const start = this.starts[row * width + column]!;
      if (this.starts[row * width + column + 1]! - start !== length) return false;
      // The last letter is the separator.
      for (let i = 0; i + 1 < length; ++i) {
        if (this.source.charCodeAt(start + i) !== this.source.charCodeAt(first + i)) return false;
      }
    }
    return true;
  }

  // A filter searches in the whole line of a row.
  line(row: number): string {
    const at = row * (this.columns.length + 1);
    return this.source.slice(this.starts[at]!, this.starts[at + this.columns.length]!);
  }

  private field_at(start: number, end: number): string {
    let last = end - 1; // the separator is no part of the field
    if (
      this.source.charCodeAt(last) === newline &&
      this.source.charCodeAt(last - 1) === carriage_return
    ) {
      --last;
    }
    if (last <= start) return "";
    if (this.source.charCodeAt(start) !== quote) return this.source.slice(start, last);
    return this.source.slice(start + 1, last - 1).replaceAll('""', '"');
  }
}

export class Row {
  constructor(
    private readonly table: Table,
    readonly index: number,
  ) {}

  text(column: string): string {
    return this.table.named(this.index, column);
  }

  // It is NaN where there is no number.
  number(column: string): number {
    return number_of(this.text(column));
  }
}

// `starts` are for each line the places where its fields start, and where the next line does. `widths` are the
// numbers of fields of the lines. A last line without an end is left out.
function fields_of(source: string): { starts: Uint32Array; widths: number[]; cut: boolean } {
  let starts = new Uint32Array(1 << 12);
  const widths: number[] = [];
  let used = 0,
    whole = 0,
    width = 0;
  const put = (start: number): void => {
    if (used === starts.length) {
      const longer = new Uint32Array(2 * used);
      longer.set(starts);
      starts = longer;
    }
    starts[used++] = start;
  };
  let quoted = false,
    line_start = 0;
  put(0);
  for (let i = 0; i < source.length; ++i) {
    const letter = source.charCodeAt(i);
    if (letter === quote) quoted = !quoted;
    else if (quoted) continue;
    else if (letter === comma) {
      put(i + 1);
      ++width;
    } else if (letter === newline) {
      const empty =
        i === line_start ||
        (i === line_start + 1 && source.charCodeAt(line_start) === carriage_return);
      if (empty) {
        starts[used - 1] = i + 1;
      } else {
        put(i + 1);
        widths.push(width + 1);
        whole = used;
        put(i + 1);
      }
      width = 0;
      line_start = i + 1;
    }
  }
  return { starts: starts.subarray(0, whole), widths, cut: line_start < source.length };
}

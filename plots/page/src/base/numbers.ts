// Sentences, charts and tables have numbers as people read them. Tables have the text of the files too.

const time_units: [number, string][] = [
  [1, "s"],
  [1e-3, "ms"],
  [1e-6, "µs"],
  [1e-9, "ns"],
];

// A time has three digits and a unit.
export function time_text(seconds: number): string {
  if (!Number.isFinite(seconds)) return "–";
  const [size, unit] = time_units.find(([least]) => seconds >= least) ?? [1e-9, "ns"];
  return `${number_text(seconds / size)} ${unit}`;
}

const length_units: [number, string][] = [
  [1, "m"],
  [1e-3, "mm"],
  [1e-6, "µm"],
  [1e-9, "nm"],
];

// A length has three digits and a unit. Less than a nanometre is in metres.
export function length_text(metres: number): string {
  const [size, unit] = length_units.find(([least]) => Math.abs(metres) >= least) ?? [1, "m"];
  return `${number_text(metres / size)} ${unit}`;
}

const three_digits = new Intl.NumberFormat("en", { maximumSignificantDigits: 3 });

export function number_text(value: number): string {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  if (value !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replaceAll("-", "−");
  return three_digits.format(value).replaceAll("-", "−");
}

// "1 frame", "2 frames".
export const counted = (count: number, what: string, plural = `${what}s`): string =>
  `${count_text(count)} ${count === 1 ? what : plural}`;

export const count_text = (value: number): string => value.toLocaleString("en");

// The text names both ends of an interval.
export const interval_text = (low: number, high: number): string =>
  Number.isNaN(low) || Number.isNaN(high)
    ? "no interval"
    : `${number_text(low)} to ${number_text(high)}`;

// The interval is that of a row's time.
export function time_interval(row: { number: (column: string) => number }): string {
  const low = row.number("seconds_low"),
    high = row.number("seconds_high");
  return Number.isNaN(low) || Number.isNaN(high)
    ? "no interval"
    : `${time_text(low)} to ${time_text(high)}`;
}

// A field of a CSV file has a number, or it is NaN. The programs write infinity and NaN as C++ does.
export function number_of(text: string): number {
  if (text === "") return NaN;
  const value = Number(text);
  if (!Number.isNaN(value)) return value;
  if (/^\+?inf(inity)?$/i.test(text)) return Infinity;
  return /^-inf(inity)?$/i.test(text) ? -Infinity : NaN;
}

export const is_number_text = (text: string): boolean =>
  !Number.isNaN(number_of(text)) || /^[+-]?nan$/i.test(text);

// A field of a table has three digits, and a unit where it is a time. Whole numbers keep their digits.
export function field_text(text: string, is_time: boolean): string {
  const value = number_of(text);
  if (!Number.isFinite(value)) return text;
  if (is_time) return value === 0 ? "0 s" : time_text(value);
  return /^[+-]?\d+$/.test(text) || text.length <= 4 ? text : number_text(value);
}

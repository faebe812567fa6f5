// Rows may be compared if they belong to the same set of a campaign. A set has a key, and a name in words.
import type { Row } from "./table";

export const set_columns = [
  "group",
  "cell",
  "scene",
  "scene_hash",
  "bodies",
  "seed",
  "boxes",
  "threads",
  "task",
  "pair_kind",
  "pairs_of",
  "rebuild",
  "isa_limit",
];

// A key may leave out some columns: rows with the same key differ in these alone.
export const set_key = (row: Row, without: string[] = []): string =>
  set_columns.map((column) => (without.includes(column) ? "" : row.text(column))).join("\n");

export function set_text(row: Row, without: string[] = []): string {
  const told = (column: string): string => (without.includes(column) ? "" : row.text(column));
  const words = [told("group"), told("cell"), told("scene")];
  if (told("bodies")) words.push(`${told("bodies")} bodies`);
  if (told("seed")) words.push(`seed ${told("seed")}`);
  if (told("boxes")) words.push(`${told("boxes")} boxes`);
  if (told("threads"))
    words.push(told("threads") === "1" ? "1 thread" : `${told("threads")} threads`);
  words.push([told("task"), told("pair_kind")].filter(Boolean).join(" "));
  if (told("pairs_of")) words.push(`pairs of ${told("pairs_of")}`);
  if (told("rebuild") === "1") words.push("built anew each frame");
  if (told("isa_limit")) words.push(`at most ${told("isa_limit")}`);
  return words.filter(Boolean).join(", ");
}

export function grouped<Value>(
  values: Iterable<Value>,
  key: (value: Value) => string,
): Map<string, Value[]> {
  const groups = new Map<string, Value[]>();
  for (const value of values) {
    const name = key(value);
    const group = groups.get(name);
    if (group) group.push(value);
    else groups.set(name, [value]);
  }
  return groups;
}

export const distinct = (texts: Iterable<string>): string[] => [...new Set(texts)];

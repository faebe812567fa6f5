// The page's reader of CSV files, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { readFile } from "node:fs/promises";
import { build } from "esbuild";
import { fileURLToPath } from "node:url";
import { csv_rows } from "./csv.mjs";
import { pair } from "./made_up.mjs";

async function sources(file) {
  const { outputFiles } = await build({
    entryPoints: [fileURLToPath(new URL(`../src/${file}`, import.meta.url))],
    bundle: true,
    format: "esm",
    write: false,
  });
  return import(
    `data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`
  );
}
const root = new URL("../../../", import.meta.url);
const { Table } = await sources("tables/table.ts");
const { field_text, number_of, time_text } = await sources("base/numbers.ts");

const fields = (table) =>
  table.rows.map((_, row) => table.columns.map((_, column) => table.field(row, column)));

test("fields are the text of the file", () => {
  const text = 'a,"b,c",d\n1,"x ""y""\nz",\r\n,,\n\n 2 ,nan,1e-09\n';
  const table = new Table(text);
  const { columns, lines } = csv_rows(text);
  assert.deepEqual(table.columns, columns);
  assert.deepEqual(fields(table), lines);
});

test("rows that are short or long, and files that are empty or cut", () => {
  assert.deepEqual(fields(new Table("a,b,c\n1\n1,2,3,4\n")), [
    ["1", "", ""],
    ["1", "2", "3"],
  ]);
  assert.deepEqual(fields(new Table("")), []);
  assert.deepEqual(fields(new Table("a,b\n")), []);
  const cut = new Table("a,b\n1,2\n3,0.00");
  assert.deepEqual(fields(cut), [["1", "2"]]);
  assert.equal(cut.cut, true);
  assert.equal(new Table('a\n"1').cut, true);
});

test("columns may have any name, and may be missing", () => {
  const table = new Table("__proto__,constructor\nx,y\n");
  assert.equal(table.rows[0].text("__proto__"), "x");
  assert.equal(table.rows[0].text("constructor"), "y");
  assert.equal(table.rows[0].text("toString"), "");
  assert.ok(Number.isNaN(table.rows[0].number("missing")));
});

test("numbers as C++ writes them", () => {
  assert.equal(number_of("inf"), Infinity);
  assert.equal(number_of("-inf"), -Infinity);
  assert.ok(Number.isNaN(number_of("nan")));
  assert.ok(Number.isNaN(number_of("")));
  assert.equal(number_of("4.3e-16"), 4.3e-16);
  assert.equal(time_text(NaN), "–");
  assert.equal(time_text(0.00123), "1.23 ms");
});

test("the page and `touchstone scene draw` have the same colours", async () => {
  const { palettes } = await sources("scene/body_material.ts");
  const source = await readFile(new URL("harness/draw/scene_picture.cpp", root), "utf8");
  const of_state = (state) => {
    const found = new RegExp(`BodyState::${state}: return \\{(.*)\\}`).exec(source);
    return found[1].split(", ").reduce((colour, part) => 256 * colour + Number(part), 0);
  };
  assert.deepEqual(palettes[0].colours, ["apart", "possible", "overlapping"].map(of_state));
});

test("the resolution is that of the program", async () => {
  const { resolution_of } = await sources("scene/resolution.ts");
  const ball = { type: "sphere", radius: 0.4 };
  const corner = [0.5, 1, 1.5];
  assert.equal(resolution_of(ball, { type: "halfspace" }), 2 ** -45);
  assert.equal(resolution_of(ball, { type: "box", half_extents: corner }), 4 * 2 ** -45);
  assert.equal(resolution_of({ type: "hull", vertices: [[0, 0, 0], corner] }, ball), 2 * 2 ** -45);
});

test("fields have three digits, and a unit where they are times", () => {
  for (const [text, is_time, short] of [
    ["5.19453768115942e-05", true, "51.9 µs"],
    ["0", true, "0 s"],
    ["1.0199296201186856", false, "1.02"],
    ["-1.0199296201186856e-12", false, "−1.02e−12"],
    ["1234567890123", false, "1234567890123"],
    ["0.97", false, "0.97"],
    ["", true, ""],
    ["inf", true, "inf"],
    ["nan", false, "nan"],
  ])
    assert.equal(field_text(text, is_time), short);
});

test("a pair is one entry, with its wrong answers first", async () => {
  const { pairs_of, pair_text } = await sources("tables/pairs.ts");
  const right = { ...pair.answers[0], algorithm: "sat", answer: "separated", grade: "right", why: "" };
  const inexact = { ...right, algorithm: "mpr", grade: "approximate" };
  const one = { ...pair, answers: [right, inexact, pair.answers[0]] };
  const other = { ...one, source: "reproductions/block-0/other.jsonl", about: "other" };
  const apart = { ...pair, id: "another", b: { ...pair.b, translation: [2, 0, 0] }, answers: [] };
  const deep = { ...one, id: "home-frame-3-1125-1129", b: apart.b, truth: { ...pair.truth, lower: -4e-3, upper: -4e-3 } };
  const pairs = pairs_of([one, other, { ...apart, b: { ...pair.b, translation: [3, 0, 0] } }, deep]);
  assert.match(pair_text(pairs.shift()), /^home, frame 3, bodies 1125 and 1129: separated by 4 mm; gjk says overlapping/);
  assert.equal(pairs.length, 2);
  assert.deepEqual(pairs[0].sources, [pair.source, other.source]);
  assert.deepEqual(pairs[0].answers.map(({ algorithm }) => algorithm), ["gjk", "mpr", "sat"]);
  assert.equal(
    pair_text(pairs[0]),
    "a thin gap: separated by 1 nm; gjk says overlapping; mpr is wrong in its numbers (approximate by design)",
  );
});

test("leads are those of the summary: suspect or too few rounds are unclear, whole scenes come first", async () => {
  const { inputs_of, leads_text, is_too_noisy, standings } = await sources("tables/contest.ts");
  const header = "scene,bodies,threads,task,pair_kind,";
  const sets = ["grid,10,1,,,", "grid,20,1,,,", "home,9,1,,,", "home,9,1,intersect,cube,"];
  const rows = {
    "times.csv":
      `${header}algorithm,origin,seconds,seconds_low,seconds_high,samples,noisy\n` +
      sets.map((set) => `${set}mine,ours,2,1.9,2.1,6,4\n${set}theirs,peer,4,,,6,3\n`).join(""),
    "ratios.csv":
      `${header}algorithm,canary,ratio,ratio_low,ratio_high,suspect\n` +
      `${sets[0]}theirs,0,3,2.9,3.1,0\n${sets[1]}theirs,0,3,2.9,3.1,1\n${sets[1]}twin,1,1,1,1,1\n`,
    "broad_best.csv":
      `${header}ours,peer,peer_ratio,peer_ratio_low,peer_ratio_high\n` +
      `${sets[0]}mine,theirs,3,2.9,3.1\n${sets[1]}mine,theirs,3,2.9,3.1\n${sets[2]}mine,theirs,2,,\n`,
    "narrow_best.csv":
      `${header}ours,right_peer,right_peer_ratio,right_peer_ratio_low,right_peer_ratio_high\n${sets[3]}mine,theirs,0.5,0.4,0.6\n`,
  };
  const folder = {
    has: (file) => file in rows,
    rows: (file) => new Table(rows[file] ?? "").rows,
  };
  const inputs = inputs_of(folder);
  assert.deepEqual(
    inputs.map(({ line, name, lead, ratio }) => [line, name, lead, ratio]),
    [
      ["home", "Which boxes overlap", "unclear", NaN],
      ["home", "Do two bodies touch, cube", "libraries", 0.5],
      ["Which boxes overlap?", "10", "ours", 3],
      ["Which boxes overlap?", "20", "unclear", NaN],
    ],
  );
  assert.equal(leads_text(inputs), "ours faster in 1 of 4, libraries in 1, unclear in 2");
  assert.equal(is_too_noisy(inputs), true);
  // The time over that of the baseline in the same rounds, where it is known: three, and not two.
  const [, theirs] = inputs[2].entries;
  assert.deepEqual([theirs.relative, theirs.low, theirs.high], [3, 2.9, 3.1]);
  const [first, second] = standings(inputs[0].entries);
  assert.deepEqual([first.algorithm, first.relative, second.relative], ["mine", 1, 2]);
});

// All fields of all tables on a page that the program made are those of the CSV files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, readdir, readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { csv_rows } from "./csv.mjs";
import { launch, open } from "./pages.mjs";

const program = process.env.PROGRAM;
const results = JSON.parse(process.env.RESULTS ?? "[]"),
  scenes = JSON.parse(process.env.SCENES ?? "[]");
const skip =
  program && results.length + scenes.length > 0
    ? false
    : "no program with results or scenes is given";

// The text of a file of rows, which may be packed: the page shows NAME.csv.zst as NAME.csv.
async function text_of(folder, file) {
  const plain = join(folder, file);
  if (existsSync(plain)) return readFile(plain, "utf8");
  return execFileSync("zstd", ["-dcq", "--", `${plain}.zst`], {
    encoding: "utf8",
    maxBuffer: 2 ** 30,
  });
}

// What the page shows of the file of a table: its columns as the headings name them, and the fields by columns. The
// table is filled first, and taken off the page afterwards: a browser takes long to work with a million fields.
async function shown(page, place) {
  const file = page.locator("div.grid:has(table[data-file])").nth(place);
  const table = file.locator("table");
  // At first numbers have three digits and a unit. Their text in the file comes on hovering.
  const rounded = await table.evaluate((table) => ({
    columns: [...table.tHead.rows[0].cells].slice(1).map((cell) => cell.dataset.column),
    lines: [...table.tBodies[0].rows].map((row) =>
      [...row.cells].slice(1).map((cell) => {
        const interval = cell.querySelector("small"); // of the number before it
        const text = cell.firstChild?.textContent ?? "";
        return [cell.title || text, text, interval && [interval.title, interval.textContent.slice(2, -1)]];
      }),
    ),
  }));
  // The mouse may miss it while parts above are still filled.
  const whole = file.getByLabel("as in the file");
  await whole.evaluate((box) => box.click());
  assert.ok(await whole.isChecked());
  const all = file.getByText("Show all", { exact: true });
  if (await all.isVisible()) await all.click();
  // A long table grows by slices.
  await all.waitFor({ state: "hidden" });
  return table.evaluate((table) => {
    const found = {
      file: table.dataset.file,
      folder: table.dataset.folder,
      columns: [...table.tHead.rows[0].cells].slice(1).map((cell) => cell.dataset.column),
      lines: [...table.tBodies[0].rows].map((row) =>
        [...row.cells].slice(1).map((cell) => cell.textContent),
      ),
    };
    table.tBodies[0].replaceChildren();
    return found;
  }).then((found) => ({ ...found, rounded }));
}

const units = { s: 1, ms: 1e-3, "µs": 1e-6, ns: 1e-9 };

// A number as the page writes it is within half of its third digit.
function check_rounded([whole, short], where) {
  if (whole === short) return;
  const [text, unit] = short.replaceAll(",", "").replace("−", "-").replace("e−", "e-").split(" ");
  const value = Number(text) * (unit ? units[unit] : 1);
  assert.ok(Math.abs(value - Number(whole)) <= 0.0051 * Math.abs(Number(whole)), `${where}: ${whole} is ${short}`);
}

test("numbers are the text of the files", { skip }, async () => {
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "page.html");
  const scene_options = scenes.length > 0 ? ["--scene", ...scenes, "--frames", "4"] : [];
  execFileSync(program, [
    "report",
    ...results,
    ...scene_options,
    "--cases",
    "5",
    "--page",
    process.env.PAGE,
    "--out",
    out,
  ]);
  const browser = await launch();
  try {
    const { page, complaints } = await open(browser, out);
    // A browser takes long to lay out a million fields, which nobody looks at here.
    await page.addStyleTag({ content: "table { display: none }" });
    await page.evaluate(() => {
      for (const details of document.querySelectorAll("details")) details.open = true;
    });
    // A part is filled in an event of its own.
    await page.waitForFunction(() =>
      [...document.querySelectorAll("details.file")].every((file) => file.querySelector("table")),
    );
    const compared = new Set(),
      folders = new Set();
    let intervals = 0;
    const tables = await page.locator("div.grid:has(table[data-file])").count();
    for (let place = 0; place < tables; ++place) {
      const { file, folder, columns, lines, rounded } = await shown(page, place);
      folders.add(folder);
      // A folder without the file has an empty table.
      if (columns.length === 0) continue;
      const expected = csv_rows(await text_of(folder, file));
      rounded.lines.forEach((line, row) =>
        line.forEach((field, column) => {
          const place = expected.columns.indexOf(rounded.columns[column]);
          assert.equal(field[0], expected.lines[row][place], `${folder}/${file}: row ${row}`);
          check_rounded(field, `${folder}/${file}`);
          if (!field[2]) return;
          const [whole, short] = field[2].map((text) => text.split(" to "));
          ["low", "high"].forEach((end, i) => {
            const column_of_end = expected.columns.indexOf(`${rounded.columns[column]}_${end}`);
            assert.equal(whole[i], expected.lines[row][column_of_end], `${folder}/${file}: row ${row}, ${end}`);
            check_rounded([whole[i], short[i]], `${folder}/${file}`);
            ++intervals;
          });
        }),
      );
      const order = columns.map((column) => expected.columns.indexOf(column));
      assert.deepEqual(
        [...order].sort((a, b) => a - b),
        [...expected.columns.keys()],
        `${file}: columns`,
      );
      assert.deepEqual(
        lines,
        expected.lines.map((line) => order.map((place) => line[place])),
        `${folder}/${file}`,
      );
      compared.add(join(folder, file));
    }
    assert.ok(folders.size >= results.length, "a folder has no table");
    assert.ok(results.length === 0 || intervals > 0, "no interval is shown");
    for (const folder of folders) {
      for (const name of await readdir(folder)) {
        const file = name.replace(/\.zst$/, "");
        if (!file.endsWith(".csv") || ["progress.csv", "jobs.csv"].includes(file)) continue;
        const { lines } = csv_rows(await text_of(folder, file));
        assert.ok(lines.length === 0 || compared.has(join(folder, file)), `${folder}/${file}`);
      }
    }
    for (const name of await page.locator("section[id$=playback]").all()) {
      await name.getByText("Open the scene").click();
      await name.locator("canvas").waitFor();
    }
    assert.deepEqual(complaints, []);
  } finally {
    await browser.close();
  }
});

// All fields of all tables on a page that the program made are those of the CSV files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
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

// What the page shows of each file: its columns as the headings name them, and the fields by columns.
const shown = () =>
  [...document.querySelectorAll("table[data-file]")].map((table) => ({
    file: table.dataset.file,
    folder: table.dataset.folder,
    columns: [...table.tHead.rows[0].cells].slice(1).map((cell) => cell.dataset.column),
    lines: [...table.tBodies[0].rows].map((row) =>
      [...row.cells].slice(1).map((cell) => cell.textContent),
    ),
  }));

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
      for (const details of document.querySelectorAll("details.file")) details.open = true;
    });
    await page.waitForTimeout(300);
    await page.evaluate(() => {
      for (const button of document.querySelectorAll("button"))
        if (button.textContent === "Show all") button.click();
    });
    const tables = await page.evaluate(shown);
    const compared = new Set();
    for (const { file, folder, columns, lines } of tables) {
      // A folder without the file has an empty table.
      if (columns.length === 0) continue;
      const expected = csv_rows(await readFile(join(folder, file), "utf8"));
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
    const folders = new Set(tables.map(({ folder }) => folder));
    assert.ok(folders.size >= results.length, "a folder has no table");
    for (const folder of folders) {
      for (const file of await readdir(folder)) {
        if (!file.endsWith(".csv") || ["progress.csv", "jobs.csv"].includes(file)) continue;
        const { lines } = csv_rows(await readFile(join(folder, file), "utf8"));
        assert.ok(lines.length === 0 || compared.has(join(folder, file)), `${folder}/${file}`);
      }
    }
    for (const _ of scenes) await page.getByText("Open the scene").first().click();
    assert.deepEqual(complaints, []);
  } finally {
    await browser.close();
  }
});

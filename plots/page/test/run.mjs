// Runs the tests of the page. Usage:
//   node test/run.mjs --page BUILT.html [--program TOUCHSTONE] [--results FOLDER]... [--scene FILE]...
// With a program, its `report` fills the pages; without one they have made-up data alone. The browser is
// $CHROMIUM or /usr/bin/chromium; without it the tests are skipped with exit code 77.
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { browser_file, has_browser } from "./pages.mjs";

const { values } = parseArgs({
  options: {
    page: { type: "string" },
    program: { type: "string" },
    results: { type: "string", multiple: true, default: [] },
    scene: { type: "string", multiple: true, default: [] },
  },
});
if (!values.page)
  throw new Error("usage: node test/run.mjs --page BUILT.html [--program TOUCHSTONE] ...");
if (!has_browser()) {
  console.log(`skipped: there is no Chromium at ${browser_file}`);
  process.exit(77);
}
const here = dirname(fileURLToPath(import.meta.url));
const tests = readdirSync(here).filter((file) => file.endsWith(".test.mjs"));
const { status } = spawnSync(
  process.execPath,
  ["--test", "--test-concurrency=2", ...tests.map((file) => resolve(here, file))],
  {
    stdio: "inherit",
    env: {
      ...process.env,
      PAGE: resolve(values.page),
      PROGRAM: values.program ? resolve(values.program) : "",
      RESULTS: JSON.stringify(values.results.map((each) => resolve(each))),
      SCENES: JSON.stringify(values.scene.map((each) => resolve(each))),
    },
  },
);
process.exit(status ?? 1);

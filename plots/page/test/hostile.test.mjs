// Results and scenes with names and numbers that nobody wants: they neither break the page nor run.
import assert from "node:assert/strict";
import { mkdtemp } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pair, recording } from "./made_up.mjs";
import { bundle_of, fill, folder_of, launch, open } from "./pages.mjs";

const evil = "<script>alert(1)</script><img src=x onerror=alert(1)>";
const quoted = `"${evil.replaceAll('"', '""')}"`;
let browser, folder;
before(async () => {
  browser = await launch();
  folder = await mkdtemp(join(tmpdir(), "page-"));
});
after(() => browser.close());

async function draws(name, bundle, look = async () => {}) {
  const file = await fill(process.env.PAGE, join(folder, `${name}.html`), bundle);
  const { page, complaints } = await open(browser, file);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.ready), "yes");
  for (const summary of await page.locator("details.file > summary").all()) await summary.click();
  await look(page);
  assert.deepEqual(complaints, []);
  assert.equal(await page.locator("img, iframe, #page script").count(), 0);
  await page.close();
}

test("names with tags are text", () =>
  draws(
    "names",
    bundle_of(
      [
        folder_of(
          evil,
          {
            "times.csv":
              `scene,bodies,algorithm,origin,seconds,seconds_low,seconds_high,find_pairs\n` +
              `${quoted},10,${quoted},ours,1e-3,1e-4,1e-2,1e-3\n${quoted},20,${quoted},${quoted},nan,inf,-inf,nan\n` +
              `${quoted},30,${quoted},peer,2e-3,,,0\n`,
            "winners.csv": `scene,bodies,winner,runner_up,ratio\n${quoted},10,${quoted},${quoted},nan\n`,
            "stress.csv": `axis,value,algorithm,silent\n${quoted},${quoted},${quoted},1\n`,
            "points.csv": `point,front,error,seconds\n${quoted},1,inf,nan\n${quoted},1,-1,1\n`,
            [`${evil}.csv`]: `${quoted}\n${quoted}\n`,
            "machine.csv": `name,value\nprocessor,${quoted}\ncommand_line,${quoted}\nscene ${quoted},1\n`,
          },
          [{ ...pair, id: evil, about: evil, line: evil, query: evil }],
        ),
      ],
      [recording(2, 3, evil)],
    ),
    async (page) => {
      assert.match(await page.locator("h2", { hasText: ": speed" }).textContent(), /<script>alert/);
      await page.locator("details.pair > summary").click();
      await page.getByText("Open the scene").click();
      await page.locator("section[id$=playback] canvas").waitFor();
    },
  ));

const header = "scene,bodies,algorithm,origin,seconds,seconds_low,seconds_high";
const odd_files = {
  nothing: {},
  empty: Object.fromEntries(
    ["times.csv", "winners.csv", "ratios.csv", "stress.csv", "points.csv", "machine.csv"].map(
      (name) => [name, ""],
    ),
  ),
  headers_alone: { "times.csv": `${header}\n`, "agreement.csv": "algorithm\n", "soak.csv": "\n" },
  other_columns: {
    "times.csv": "a,b\n1,2\n",
    "winners.csv": "x\n1\n",
    "speed_ups.csv": "x\n1\n",
    "points.csv": "x\n1\n",
    "stress.csv": "x\n1\n",
    "summary.csv": "x\n1\n",
    "departures.csv": "x\n1\n",
    "ratios.csv": "x\n1\n",
    "broad_best.csv": "x\n1\n",
    "front.csv": "x\n1\n",
  },
  no_numbers: {
    "times.csv": `${header}\ns,many,a,ours,nan,inf,-inf\ns,-5,a,ours,-1,0,0\ns,0,a,ours,0,0,0\ns,inf,a,ours,inf,,\n`,
  },
  cut: {
    "times.csv": `${header}\ns,10,a,ours,0.1,0.1,0.1\ns,20,a,ours,0.`,
    "raw.csv": 'kind,scene\nsample,"s',
  },
};

for (const [name, files] of Object.entries(odd_files)) {
  test(`odd files: ${name}`, () =>
    draws(name, bundle_of([folder_of(name, files), folder_of(name, files)]), async (page) => {
      if (name !== "cut") return;
      assert.equal(
        await page.locator('table[data-file="times.csv"]').first().locator("tbody tr").count(),
        1,
      );
      assert.match(await page.textContent("#page"), /ends within a row/);
    }));
}

test("pairs and scenes without numbers", () =>
  draws(
    "without_numbers",
    bundle_of(
      [
        folder_of("f", {}, [
          {
            ...pair,
            truth: { answer: "unknown", lower: null, upper: null, normal: null },
            answers: [],
            proof: { plane: null, point: null, on_a: null, on_b: null, ball: null },
            b: { ...pair.b, shape: { type: "hull", vertices: [[0, 0, 0]], faces: [] } },
          },
        ]),
      ],
      [
        { ...recording(1), pairs: [], structures: [], time_step: 0 },
        {
          ...recording(1, 3, "none"),
          frames: 0,
          bodies: 0,
          shape_of: [],
          poses: "",
          boxes: "",
          pairs: [],
        },
      ],
    ),
    async (page) => {
      await page.locator("details.pair > summary").click();
      for (const scene of await page.locator("section[id$=playback]").all()) {
        await scene.getByText("Open the scene").click();
        await scene.locator("canvas").waitFor();
      }
      assert.equal(await page.locator("canvas").count(), 2);
    },
  ));

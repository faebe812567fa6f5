// The page without a mouse, and for eyes that need contrast.
import assert from "node:assert/strict";
import { mkdtemp } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { raw_csv, recording, times_csv } from "./made_up.mjs";
import { bundle_of, fill, folder_of, launch, open } from "./pages.mjs";

const outcomes = ["right", "rounded", "honest", "silent", "crashed", "hung"];
const stress_rows = outcomes.map(
  (worst, i) => `gap,1e-${i},gjk,float,distance,${outcomes.map((each) => Number(each === worst))}\n`,
);
const best_rows = [0.1, 0.5, 1, 3.9, 20].map((lead, i) => `grid,${i},a,b,${lead},${lead * 0.9},${lead * 1.1}\n`);
const best_times = best_rows.flatMap((_, i) => [`grid,${i},a,ours,1\n`, `grid,${i},b,peer,2\n`]);

let browser, file;
before(async () => {
  browser = await launch();
  const names = Array.from({ length: 12 }, (_, i) => `algorithm ${i}`);
  const rows = [100, 1000].flatMap((bodies) =>
    names.map((name, i) => [bodies, name, "ours", bodies * 1e-7 * (i + 1)]),
  );
  const results = folder_of("made", {
    "times.csv": times_csv(rows),
    "raw.csv": raw_csv(30),
    "stress.csv": `axis,value,algorithm,scalar,task,${outcomes}\n${stress_rows.join("")}`,
    "points.csv":
      "point,front,error,seconds,seconds_low,seconds_high\nfast,1,0.1,0.001,0.0009,0.0011\nright,1,0,0.01,0.009,0.011\n",
  });
  const best = folder_of("best", {
    "times.csv": `scene,bodies,algorithm,origin,seconds\n${best_times.join("")}`,
    "broad_best.csv": `scene,bodies,ours,peer,peer_ratio,peer_ratio_low,peer_ratio_high\n${best_rows.join("")}`,
  });
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "page.html");
  file = await fill(process.env.PAGE, out, bundle_of([results, best], [recording(10)]));
});
after(() => browser.close());

async function on_page(work, options = {}) {
  const { page, complaints } = await open(browser, file, "", options);
  await work(page);
  assert.deepEqual(complaints, []);
  await page.close();
}

const focused = (page) =>
  page.evaluate(() => {
    const row = document.activeElement.closest("tr");
    return row ? row.sectionRowIndex : -1;
  });

test("rows are reached and picked by keys", () =>
  on_page(async (page) => {
    const table = page.locator('table[data-file="points.csv"]');
    assert.equal(await table.getAttribute("role"), "grid");
    assert.equal(await table.locator('tbody tr[tabindex="0"]').count(), 1);
    // The Tab key comes from the last heading to the address of the first row's number, or to the row itself.
    await table.locator("th button.sort").last().focus();
    await page.keyboard.press("Tab");
    assert.equal(await focused(page), 0);
    await page.keyboard.press("ArrowDown");
    assert.equal(await focused(page), 1);
    await page.keyboard.press("ArrowDown");
    assert.equal(await focused(page), 1);
    await page.keyboard.press("Enter");
    const details = page.locator("#made-configuration");
    assert.equal(await details.locator("h4").textContent(), "right");
    assert.equal(await table.locator('tr[aria-selected="true"]').count(), 1);
    await page.keyboard.press("Home");
    assert.equal(await focused(page), 0);
    await page.keyboard.press("Space");
    assert.equal(await details.locator("h4").textContent(), "fast");
    await table.locator('th[data-column="error"] button').press("Enter");
    assert.equal(await table.locator('tbody tr[tabindex="0"]').count(), 1);
  }));

test("keys go from body to body, and stay among the rows", () =>
  on_page(async (page) => {
    await page.getByText("Open the scene").press("Enter");
    const scene = page.locator("#made-up-playback");
    await scene.getByLabel("Body").fill("1");
    await scene.getByLabel("Body").press("Enter");
    await scene.locator("tr.pickable").focus();
    await page.keyboard.press("Enter");
    assert.equal(await scene.getByLabel("Body").inputValue(), "0");
    assert.equal(await focused(page), 0);
    await page.keyboard.press("Enter");
    assert.equal(await scene.getByLabel("Body").inputValue(), "1");
  }));

// The contrast of each text of the charts and the matrix with what is under it, or with the page.
const contrasts = () => {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const luminance = (colour) => {
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((value) => {
      const part = value / 255;
      return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ground = getComputedStyle(document.body).backgroundColor;
  const contrast = (colour, under) => {
    const [high, low] = [luminance(colour), luminance(under)].sort((a, b) => b - a);
    return (high + 0.05) / (low + 0.05);
  };
  const cells = [...document.querySelectorAll(".matrix td b, .matrix td small")].map((text) => ({
    text: text.textContent,
    contrast: contrast(getComputedStyle(text).color, getComputedStyle(text.closest("td")).backgroundColor),
  }));
  const letters = [...document.querySelectorAll("figure svg text")]
    .filter((text) => text.textContent && text.getClientRects().length > 0)
    .map((text) => {
      const box = text.getBoundingClientRect();
      const x = (box.left + box.right) / 2,
        y = (box.top + box.bottom) / 2;
      const under = [...text.ownerSVGElement.querySelectorAll("rect")].find((rect) => {
        const of_rect = rect.getBoundingClientRect();
        return of_rect.left <= x && x <= of_rect.right && of_rect.top <= y && y <= of_rect.bottom;
      });
      return {
        text: text.textContent,
        contrast: contrast(getComputedStyle(text).fill, under ? getComputedStyle(under).fill : ground),
      };
    });
  return [...cells, ...letters];
};

for (const colorScheme of ["light", "dark"]) {
  test(`letters have contrast: ${colorScheme}`, () =>
    on_page(
      async (page) => {
        const all = await page.evaluate(contrasts);
        for (const text of ["find pairs", "~", "✗", "…", "algorithm 7", "0.1", "= 1", "20"])
          assert.ok(all.some((each) => each.text === text), `there is no ${text}`);
        assert.deepEqual(
          all.filter(({ contrast }) => contrast < 4.5),
          [],
        );
      },
      { colorScheme },
    ));
}

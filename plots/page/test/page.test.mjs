// What a reader does with the page: switch, sort, filter, hover, click, follow links, play.
import assert from "node:assert/strict";
import { mkdtemp } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { boxes_alone, deep_pair, pair, raw_csv, recording, times_csv } from "./made_up.mjs";
import { bundle_of, fill, folder_of, launch, open, until } from "./pages.mjs";

let browser, file;

before(async () => {
  browser = await launch();
  const rows = [100, 1000, 10000].flatMap((bodies) => [
    [bodies, "tree", "ours", bodies * 1e-7],
    [bodies, "their-tree", "peer", bodies * 3e-7],
  ]);
  const many = Array.from({ length: 500 }, (_, i) => `${i},x${i},${(i * 37) % 500}\n`).join("");
  const results = folder_of(
    "made",
    {
      "times.csv": times_csv(rows),
      "raw.csv": raw_csv(30),
      "work.csv": `number,name,shuffled\n${many}`,
      "departures.csv": `block,algorithm,where,what,reproduction\n0,gjk float,here,wrong,results/local/made/${pair.source}\n`,
      "summary.csv":
        "algorithm,scalar,regime,group,answers,silent,margin\ngjk,float,thin,gaps,10,1,1e-9\ngjk,float,deep,depths,10,0,0\n",
      "stress.csv":
        "axis,value,algorithm,scalar,task,right,rounded,honest,silent,crashed,hung\ngap,1e-3,gjk,float,distance,1,0,0,0,0,0\ngap,1e-6,gjk,float,distance,0,0,0,1,0,0\n",
      "points.csv":
        "point,front,error,seconds,seconds_low,seconds_high\nfast,1,0.1,0.001,0.0009,0.0011\nright,1,0,0.01,0.009,0.011\n",
      "machine.csv":
        'name,value\nprocessor,a processor\ncommand_line,touchstone advise --front\n"scene grid, 100 bodies",h100\n',
    },
    [pair, deep_pair],
  );
  const scenes = [
    recording(10),
    boxes_alone(4),
    recording(4, 2000, "large"),
    { ...recording(2, 3, "fixed"), fixed: [0] },
    recording(2, 3, "near", 1e-14),
  ];
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "page.html");
  file = await fill(process.env.PAGE, out, bundle_of([results], scenes));
});
after(() => browser.close());

async function on_page(work, hash = "", options = {}) {
  const { page, complaints } = await open(browser, file, hash, options);
  await work(page);
  assert.deepEqual(complaints, []);
  await page.close();
}

// A table is filled after the click that opens its part.
const column = async (page, data_file, name) => {
  await page.waitForSelector(`table[data-file="${data_file}"]`, { state: "attached" });
  return page.evaluate(
    ([data_file, name]) => {
      const table = document.querySelector(`table[data-file="${data_file}"]`);
      const place = [...table.tHead.rows[0].cells].findIndex(
        (cell) => cell.dataset.column === name,
      );
      return [...table.tBodies[0].rows].map((row) => row.cells[place].textContent);
    },
    [data_file, name],
  );
};

test("algorithms are switched, all and none too", () =>
  on_page(async (page) => {
    const curves = page.locator("#made-curves");
    const lines = (which = "algorithm") => curves.locator(`g[aria-description="${which}"] path`).count();
    assert.equal(await lines(), 2);
    assert.ok((await lines("best")) > 0);
    await curves.getByText("choose among 2").click();
    await curves.getByLabel("their-tree").uncheck();
    assert.equal(await lines(), 1);
    await curves.getByText("none", { exact: true }).click();
    assert.equal(await lines(), 0);
    await curves.getByText("all", { exact: true }).click();
    assert.equal(await lines(), 2);
  }));

test("tables sort by number, filter, and show all", () =>
  on_page(async (page) => {
    await page.locator("#made-other-tables summary", { hasText: "work.csv" }).click();
    const grid = page.locator("#made-work");
    assert.equal((await column(page, "work.csv", "shuffled")).length, 200);
    await grid.getByText("Show all").click();
    await until(
      async () => (await column(page, "work.csv", "shuffled")).length === 500,
      "all rows",
    );
    const sort = grid.locator('th[data-column="shuffled"] button');
    await sort.focus();
    await page.keyboard.press("Enter");
    assert.deepEqual((await column(page, "work.csv", "shuffled")).slice(0, 3), ["0", "1", "2"]);
    await sort.click();
    assert.deepEqual((await column(page, "work.csv", "shuffled")).slice(0, 2), ["499", "498"]);
    await grid.getByLabel("filter the table").fill("x77");
    assert.deepEqual(await column(page, "work.csv", "name"), ["x77"]);
  }));

test("grades filter by regime and by the size of an error", () =>
  on_page(async (page) => {
    const grades = page.locator("#made-grades");
    await grades.getByLabel("errors of at least").selectOption("1e-9");
    assert.deepEqual(await column(page, "summary.csv", "regime"), ["thin"]);
    await grades.getByLabel("errors of at least").selectOption("(all)");
    await grades.getByRole("combobox", { name: "regime" }).selectOption("deep");
    assert.deepEqual(await column(page, "summary.csv", "regime"), ["deep"]);
  }));

test("hovering tells, and clicking shows the samples", () =>
  on_page(async (page) => {
    const chart = page.locator("#made-curves figure svg");
    const dot = chart.locator('g[aria-description="points"] circle').first();
    await dot.scrollIntoViewIfNeeded();
    await dot.hover({ force: true });
    const tip = chart.locator('g[aria-label="tip"]');
    await until(async () => /bodies/.test(await tip.textContent()), "a tip");
    await page.locator('table[data-file="times.csv"] tbody tr').first().focus();
    await page.keyboard.press("Enter");
    const samples = page.locator("#made-samples");
    assert.match(await samples.textContent(), /30 samples, of which 6 were disturbed/);
    assert.equal(await samples.locator('g[aria-label="dot"] path').count(), 30);
  }));

test("cells have a race, crosses beside who was wrong, and samples", async () => {
  const header = "group,cell,algorithm,origin,";
  const graded = "missed,false_hits,inexact,status";
  const cells = ["box", "hull"].flatMap((cell) => [`hit,${cell},mine,ours,`, `hit,${cell},theirs,peer,`]);
  const results = folder_of("cells", {
    "set_grades.csv": `${header}${graded}\n${cells.map((cell) => `${cell}0,0,0,ok\n`).join("")}`,
    "set_times.csv":
      `${header}${graded},seconds,seconds_low,seconds_high,samples\n` +
      cells.map((cell, i) => `${cell}${i === 1 ? 3 : 0},0,0,ok,${i + 1}e-7,${i + 1}e-7,${i + 1}e-7,6\n`).join(""),
    "set_best.csv":
      "group,cell,ours,peer,ratio,ratio_low,ratio_high\nhit,box,mine,theirs,2,1.9,2.1\nhit,hull,mine,theirs,3,2.9,3.1\n",
    "raw.csv":
      "kind,process,square,round,position,phase,seconds,pair_count,noise,twin,query_kind,input,family,algorithm\n" +
      Array.from({ length: 6 }, (_, i) => `sample,0,${i},0,0,answer,1.8e-6,9,${i ? "" : "steal"},,cast,hit,box,theirs\n`).join("") +
      "sample,0,0,0,1,answer,1.8e-6,9,,1,cast,hit,box,theirs\n",
  });
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "cells.html");
  const { page, complaints } = await open(browser, await fill(process.env.PAGE, out, bundle_of([results], [])));
  const race = page.locator("#fastest .race svg");
  assert.equal(await race.locator('g[aria-label="dot"] circle').count(), 2);
  assert.equal(await race.locator("text", { hasText: "✕" }).count(), 1);
  assert.match(await page.locator("#fastest .told").textContent(), /ours faster in 2 of 2; median 2\.45 ×/);
  assert.match(await page.locator("#fastest .faults").textContent(), /wrong: theirs/);
  await page.locator('table[data-file="set_times.csv"] tbody tr').nth(1).focus();
  await page.keyboard.press("Enter");
  assert.match(await page.locator("#cells-samples").textContent(), /6 samples, of which 1 were disturbed/);
  assert.deepEqual(complaints, []);
  await page.close();
});

// Two scenes and two questions. The library is equal to ours on cubes, and wrong on hulls. Another has no quiet sample.
const raced = () => {
  const header = "scene,bodies,threads,task,pair_kind,";
  const sets = ["grid,100,1,,,", "grid,100,2,,,", "pile,9,1,distance,cube,", "pile,9,1,distance,hull,"];
  const times = sets.flatMap((set, i) => [
    `${set}mine,ours,frame,1e-6,9e-7,1.1e-6,0,12,1\n`,
    `${set}slow float,ours,frame,4e-6,3.9e-6,4.1e-6,0,12,1\n`,
    `${set}theirs,peer,frame,${[3, 5, 1, 0.5][i]}e-6,,,${Number(i === 3)},12,1\n`,
  ]);
  return folder_of("raced", {
    "times.csv": `${header}algorithm,origin,unit,seconds,seconds_low,seconds_high,wrong,samples,noisy\n${times.join("")}`,
    "agreement.csv": `${header}algorithm,origin,queries,wrong,worst_error,depth_bound\n${sets[3]}theirs,peer,50,7,,0\n${sets[3]}untimed,peer,50,3,,0\n`,
    "broad_best.csv":
      `${header}ours,peer,peer_ratio,peer_ratio_low,peer_ratio_high\n` +
      `${sets[0]}mine,theirs,3,2.8,3.2\n${sets[1]}mine,theirs,5,4.8,5.2\n`,
    "narrow_best.csv":
      `${header}ours,right_peer,right_peer_ratio,right_peer_ratio_low,right_peer_ratio_high\n` +
      `${sets[2]}mine,theirs,1.01,0.9,1.1\n${sets[3]}mine,,0,0,0\n`,
    "winners.csv":
      `${header}winner,runner_up,ratio,ratio_low,ratio_high\n` +
      `${sets[0]}mine,theirs,3,2.8,3.2\n${sets[2]}mine,theirs,1.01,0.9,1.1\n`,
  });
};

async function on_race(work, hash = "") {
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "race.html");
  const { page, complaints } = await open(browser, await fill(process.env.PAGE, out, bundle_of([raced()])), hash);
  const first = page.locator("#fastest");
  await work({
    page,
    first,
    // The names from the top, without the texts of the axis and beside the bars.
    names: () =>
      first.locator(".race svg text").evaluateAll((texts) =>
        texts.map((each) => each.textContent).filter((each) => /^(mine|slow float|theirs)$/.test(each)),
      ),
    caption: () => first.locator(".race figcaption").textContent(),
  });
  assert.deepEqual(complaints, []);
  await page.close();
}

test("the first screen says who is fastest and who is right, and its state is in the address", () =>
  on_race(async ({ page, first, names, caption }) => {
    assert.deepEqual(await first.locator(".told").allTextContents(), [
      "ours faster in 2 of 2; median 3.87 × (3 … 5)",
      "ours faster in 0 of 2, equal in 1, no library is right in 1; 1.01 ×",
    ]);
    assert.match(await first.locator(".faults").textContent(), /Libraries: wrong: theirs \(7 of 50 answers\), untimed \(3 of 50 answers\)\. Ours: all right\./);
    // One thread alone is shown at first.
    assert.equal(await first.getByLabel("Threads").locator("option:checked").textContent(), "1");
    assert.deepEqual(await names(), ["mine", "theirs", "slow float"]);
    assert.match(await caption(), /mine is 3 × \(2\.8 to 3\.2\) as fast as theirs/);
    await first.getByRole("button", { name: "How far apart" }).click();
    assert.equal(await first.locator(".inputs svg text", { hasText: "no library is right" }).count(), 1);
    await first.getByLabel("Kind").selectOption("hull");
    assert.deepEqual(await names(), ["theirs", "mine", "slow float"]);
    assert.equal(await first.locator(".race svg text", { hasText: "✕" }).count(), 1);
    await first.getByLabel("Kind").selectOption("cube");
    assert.match(await caption(), /mine = theirs/);
    await first.getByLabel("Numbers").or(first.getByLabel("Show")).first().selectOption("ours alone");
    assert.deepEqual(await names(), ["mine", "slow float"]);
    const address = new URLSearchParams(new URL(page.url()).hash.split("?")[1]);
    assert.equal(address.get("kind"), "cube");
    assert.equal(address.get("show"), "ours alone");
  }));

test("the summary counts what is approximate by design apart", async () => {
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "race.html");
  const text = async (approximate) => {
    const bundle = { ...bundle_of([raced()]), approximate };
    const { page } = await open(browser, await fill(process.env.PAGE, out, bundle));
    const told = await page.locator("#raced-overview").textContent();
    await page.close();
    return told;
  };
  assert.match(await text([]), /The libraries answered 100 queries: 10 on the wrong side of contact,[^.]*\.(?! Of)/);
  assert.match(
    await text(["untimed"]),
    /100 queries: 7 on the wrong side of contact,[^.]*\. Of untimed, approximate by design, 3 more on the wrong side\./,
  );
});

test("below six undisturbed squares nobody leads", async () => {
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "few.html");
  const told = async (squares) => {
    const results = folder_of("few", {
      "times.csv":
        "scene,bodies,algorithm,origin,unit,seconds,seconds_low,seconds_high,squares,samples,noisy\n" +
        `grid,9,mine,ours,frame,1,1,1,6,9,0\ngrid,9,theirs,peer,frame,3,3,3,${squares},9,0\ngrid,9,other,peer,frame,4,4,4,4,9,0\n`,
      "broad_best.csv": "scene,bodies,ours,peer,peer_ratio,peer_ratio_low,peer_ratio_high\ngrid,9,mine,theirs,3,2.8,3.2\n",
    });
    const { page } = await open(browser, await fill(process.env.PAGE, out, bundle_of([results])));
    const text = await page.locator("#fastest .told").textContent();
    await page.close();
    return text;
  };
  assert.equal(await told(6), "ours faster in 1 of 1; 3 ×");
  assert.equal(await told(5), "ours faster in 0 of 1, unclear in 1");
});

test("an address brings the state of the first screen back", () =>
  on_race(
    async ({ page, first, names }) => {
      assert.deepEqual(await names(), ["theirs"]);
      assert.equal(await first.locator('[aria-pressed="true"] .name').textContent(), "How far apart are they?");
      await page.evaluate(() => (location.hash = "#fastest?question=nothing&kind=none&show=__proto__&threads=2"));
      await until(async () => (await names()).length === 3, "the first question again");
    },
    `#fastest?${new URLSearchParams({ question: "How far apart are they?", kind: "cube", show: "libraries alone" })}`,
  ));

test("a matrix shows who leads, and what is equal", () =>
  on_race(async ({ page }) => {
    const cells = page.locator("#raced-fastest .matrix td:not(.none)");
    const seen = await cells.evaluateAll((all) => all.filter((each) => each.textContent).map((each) => [each.className, each.textContent]));
    assert.deepEqual(seen, [
      ["ours", "3 2.8 to 3.2mine / theirs"],
      ["ours", "5 4.8 to 5.2mine / theirs"],
      ["equal", "= 1.01 0.9 to 1.1mine / theirs"],
      ["alone", "no library is rightmine"],
    ]);
  }));

test("a matrix of scenes that share no number of bodies has one column", async () => {
  const out = join(await mkdtemp(join(tmpdir(), "page-")), "sparse.html");
  const heads = async (counts) => {
    const header = "scene,bodies,threads,task,pair_kind,";
    const sets = counts.map((bodies, i) => `scene${i},${bodies},1,,,`);
    const results = folder_of("sparse", {
      "times.csv":
        `${header}algorithm,origin,unit,seconds,seconds_low,seconds_high,wrong,samples,noisy\n` +
        sets.map((set) => `${set}mine,ours,frame,1,1,1,0,9,0\n${set}theirs,peer,frame,3,3,3,0,9,0\n`).join(""),
      "broad_best.csv":
        `${header}ours,peer,peer_ratio,peer_ratio_low,peer_ratio_high\n` +
        sets.map((set) => `${set}mine,theirs,3,2.8,3.2\n`).join(""),
    });
    const { page } = await open(browser, await fill(process.env.PAGE, out, bundle_of([results])));
    const all = await page.locator("#sparse-fastest .matrix th").allTextContents();
    await page.close();
    return all;
  };
  assert.deepEqual(await heads([10, 20, 1000]), [
    "Which boxes overlap?", "scene0, 10 bodies", "scene1, 20 bodies", "scene2, 1,000 bodies",
  ]);
  assert.deepEqual(await heads([10, 10, 1000]), ["10 bodies", "1,000 bodies", "scene0", "scene1", "scene2"]);
});

test("a departure leads to its pair, which is drawn", () =>
  on_page(async (page) => {
    await page.locator('table[data-file="departures.csv"] a', { hasText: "3D" }).click();
    const view = page.locator("#made-pair-1");
    await view.locator("canvas").waitFor();
    const picture = () => view.locator("canvas").screenshot();
    const whole = await picture();
    await view.getByText("show the gap").click();
    await until(async () => !(await picture()).equals(whole), "a picture of the gap");
    const enlarged = await picture();
    await view.locator("canvas").focus();
    await page.keyboard.press("ArrowLeft");
    await until(async () => !(await picture()).equals(enlarged), "a view from another side");
    assert.match(await view.textContent(), /touchstone query/);
  }));

test("addresses lead to rows that are not shown, to fields and to pairs", async () => {
  await on_page(async (page) => {
    assert.equal(await page.locator("#made-work-row-431 td").first().textContent(), "431");
    assert.ok(await page.locator("#made-work-row-431").isVisible());
  }, "#made-work-row-431");
  await on_page(
    async (page) => assert.equal(await page.locator("td.target").textContent(), "x7"),
    "#made-work-row-7-name",
  );
  await on_page(async (page) => page.locator("#made-pair-1 canvas").waitFor(), "#made-pair-1");
  await on_page(
    async (page) => assert.ok(await page.locator("#made-breaks").isVisible()),
    "#%E0%A4%A",
  );
});

test("a scene plays, steps, and shows where two algorithms differ", () =>
  on_page(async (page) => {
    const scene = page.locator("#made-up-playback");
    await scene.getByText("Open the scene").click();
    const frame = () => scene.locator("span.frame").textContent();
    assert.match(await frame(), /^frame 0 /);
    await scene.getByLabel("one frame on").click();
    assert.match(await frame(), /^frame 1 /);
    await scene.getByLabel("one frame back").click();
    await scene.getByLabel("one frame back").click();
    assert.match(await frame(), /^frame 9 /);
    await scene.getByText("Play", { exact: true }).click();
    await page.waitForFunction(
      () => !/^frame 9 /.test(document.querySelector("span.frame").textContent),
    );
    await scene.getByText("Pause", { exact: true }).click();
    await scene.getByLabel("side by side").check();
    await scene.getByLabel("boxes").check();
    await scene.getByLabel("Structure of").selectOption("uniform-grid");
    assert.match(await scene.textContent(), /certified and gjk differ on 1 of them/);
    await scene.getByLabel("Body").fill("1");
    await scene.getByLabel("Body").press("Enter");
    assert.match(await scene.locator(".pairs-of-frame").textContent(), /Body 1 has 1 pair /);
    const boxes = page.locator("#boxes-alone-playback");
    await boxes.getByText("Open the scene").click();
    await boxes.locator("canvas").waitFor();
  }));

// A page that works for long at a time neither says how far it is, nor answers.
test("a scene opens in slices, between which the page answers", () =>
  on_page(async (page) => {
    const seen = await page.evaluate(async () => {
      const section = document.getElementById("large-playback");
      const answers = [],
        told = new Set();
      const watcher = new MutationObserver(() => {
        const status = section.querySelector('[role="status"]');
        if (status) told.add(status.textContent.replace(/, .*/, ""));
      });
      watcher.observe(section, { childList: true, subtree: true, characterData: true });
      [...section.querySelectorAll("button")].find((each) => each.textContent === "Open the scene").click();
      while (!section.querySelector("canvas")) {
        answers.push(section.querySelector("button").textContent);
        await new Promise((resolve) => setTimeout(resolve));
      }
      return { answers, told: [...told] };
    });
    assert.deepEqual(seen.told, [
      "Opening: reading poses",
      "Opening: reading boxes",
      "Opening: making a picture",
      "Opening: making bodies",
      "Opening: making shaders",
      "Opening: making controls",
    ]);
    assert.ok(seen.answers.length > 0 && seen.answers.every((each) => each === "Close the scene"));
  }));

test("a scene is drawn by a browser that at first draws nothing in three dimensions", () =>
  on_page(async (page) => {
    await page.evaluate(() => {
      const real = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function () {
        HTMLCanvasElement.prototype.getContext = real;
        return null;
      };
    });
    const scene = page.locator("#fixed-playback");
    await scene.getByText("Open the scene").click();
    await scene.locator("canvas").waitFor();
  }));

test("a scene that is closed while it opens is not drawn", () =>
  on_page(async (page) => {
    const scene = page.locator("#large-playback");
    await page.evaluate(() => {
      const press = (text) =>
        [...document.querySelectorAll("#large-playback button")].find((each) => each.textContent === text).click();
      press("Open the scene");
      press("Close the scene");
      press("Open the scene");
    });
    await scene.locator("canvas").waitFor();
    assert.equal(await page.locator("canvas").count(), 1);
    await scene.getByText("Close the scene").click();
    await scene.getByText("Open the scene").waitFor();
    assert.equal(await page.locator("canvas").count(), 0);
  }));

// The states of bodies 0 and 1, which overlap, and of 2, by the colours of the middle of the picture.
test("what touches fixed bodies alone is not coloured, unless that is asked for", () =>
  on_page(async (page) => {
    const scene = page.locator("#fixed-playback");
    await scene.getByText("Open the scene").click();
    const picture = () => scene.locator("canvas").screenshot();
    const points = () => scene.locator("canvas").evaluate((canvas) => canvas.width / canvas.clientWidth);
    await until(async () => (await points()) === 2, "a fine picture");
    assert.match(await scene.textContent(), /Red, dotted: touches or overlaps a body that is not fixed/);
    const without = await picture();
    await scene.getByLabel("contacts with fixed bodies").check();
    await until(async () => !(await picture()).equals(without), "a contact");
    assert.match(await scene.textContent(), /Red, dotted: touches or overlaps another body/);
    await scene.getByLabel("contacts with fixed bodies").uncheck();
    await until(async () => (await picture()).equals(without), "no contact");
    await scene.getByLabel("Colours").selectOption("red, green, blue");
    await until(async () => !(await picture()).equals(without), "other colours");
    assert.match(await scene.textContent(), /Blue, dotted: touches or overlaps a body that is not fixed/);
  }));

test("answers that differ within the resolution are not counted as differing", () =>
  on_page(async (page) => {
    const scene = page.locator("#near-playback");
    await scene.getByText("Open the scene").click();
    await scene.locator("canvas").waitFor();
    const text = await scene.textContent();
    assert.match(text, /certified and gjk differ on 0 of them\. On 1 they differ within the resolution/);
    assert.equal(await scene.locator("tr.pickable").count(), 0);
    await scene.getByLabel("list pairs within the resolution").check();
    assert.equal(await scene.locator("tr.pickable").count(), 1);
    await scene.getByText("next difference").click();
    await scene.getByText("they differ in no frame").waitFor();
  }));

test("a body is picked by mouse", () =>
  on_page(async (page) => {
    for (const name of ["made-up", "boxes-alone"]) {
      const scene = page.locator(`#${name}-playback`);
      await scene.getByText("Open the scene").click();
      await scene.locator("canvas").click();
      await until(async () => (await scene.getByLabel("Body").inputValue()) === "1", "a choice");
    }
  }));

test("a scene that plays too slowly is drawn with fewer points, until it stands still", () =>
  on_page(async (page) => {
    const scene = page.locator("#made-up-playback");
    await scene.getByText("Open the scene").click();
    const points = () => scene.locator("canvas").evaluate((canvas) => canvas.width / canvas.clientWidth);
    await until(async () => (await points()) === 2, "a fine picture");
    const picture = () => scene.locator("canvas").screenshot();
    const still = await picture();
    await page.evaluate(() => {
      window.slow = true;
      const wait = () => {
        const end = performance.now() + 50;
        while (performance.now() < end);
        if (window.slow) requestAnimationFrame(wait);
      };
      wait();
    });
    await scene.getByText("Play", { exact: true }).click();
    await page.waitForFunction(() => {
      const canvas = document.querySelector("canvas");
      return canvas.width < 0.6 * canvas.clientWidth;
    });
    await scene.getByText("Pause", { exact: true }).click();
    await page.evaluate(() => (window.slow = false));
    await scene.getByLabel("frame", { exact: true }).fill("0");
    await until(
      async () => (await points()) === 2 && (await picture()).equals(still),
      "the same picture, as fine as before",
    );
  }));

test("on a phone the switches are folded, and the lines have their names", () =>
  on_page(
    async (page) => {
      const curves = page.locator("#made-curves");
      assert.equal(await curves.getByLabel("their-tree").isVisible(), false);
      const race = page.locator("#fastest .race");
      for (const [part, name] of [[curves, "tree"], [curves, "their"], [race, "tree"], [race, "their-tree"]]) {
        const box = await part.locator("svg text", { hasText: new RegExp(`^${name}$`) }).boundingBox();
        assert.ok(box.x >= 0 && box.x + box.width <= 390, `${name} is at ${box.x} to ${box.x + box.width}`);
      }
      assert.equal(await page.locator("#fastest").getByLabel("Show").isVisible(), false);
      await page.locator("#fastest").getByText("Filters").click();
      await page.locator("#fastest").getByLabel("Show").selectOption("ours alone");
      assert.equal(await race.locator('g[aria-label="dot"] circle').count(), 1);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= 390, `the page is ${wide} wide`);
    },
    "",
    { viewport: { width: 390, height: 800 } },
  ));

test("columns that say nothing are left out, until the file is shown as it stands", () =>
  on_page(async (page) => {
    const grid = page.locator("#made-times");
    const columns = () => grid.locator("th[data-column]").evaluateAll((heads) => heads.map((head) => head.dataset.column));
    assert.deepEqual(await columns(), [
      "bodies", "algorithm", "origin", "seconds", "update", "find_pairs",
    ]);
    assert.match(await grid.textContent(), /The same in all rows: scene grid, threads 1, .*Empty in all rows: task, pair kind/);
    const time = grid.locator("tbody tr").first().locator("td").nth(3);
    assert.equal(await time.textContent(), "10 µs (9 µs to 11 µs)");
    assert.match(await time.locator("small").getAttribute("title"), /^0\.000009 to 0\.000011/);
    await grid.getByLabel("as in the file").check();
    assert.equal((await columns()).length, 20);
    assert.ok((await grid.locator("tbody tr").first().locator("td").allTextContents()).includes("0.000009"));
    const downloading = page.waitForEvent("download");
    await grid.getByText("Download").click();
    assert.equal((await downloading).suggestedFilename(), "times.csv");
  }));

test("narrow, dark and printed", async () => {
  await on_page(
    async (page) => {
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= 700, `the page is ${wide} wide`);
      const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      assert.equal(ground, "rgb(20, 23, 26)");
    },
    "",
    { viewport: { width: 700, height: 900 }, colorScheme: "dark" },
  );
  await on_page(async (page) => {
    await page.emulateMedia({ media: "print" });
    assert.equal(await page.locator("nav").isVisible(), false);
    assert.ok((await page.pdf({ pageRanges: "1" })).length > 1000);
  });
});

test("a cell of the versions opens its pairs, with proof and test", async () => {
  const answer = (algorithm, grade, why) => ({ ...pair.answers[0], algorithm, scalar: "double", task: "signed", grade, why });
  const recorded = (id, group, tests, ...answers) => ({
    ...pair, id, source: "wrong_pairs.jsonl", answers: [], recorded: { group, answers, tests },
  });
  const results = folder_of(
    "versions",
    {
      "versions.csv":
        "library,version,algorithm,scalar,group,answers,wrong,wrong_pairs,gave_up,failed,worst,worst_case\n" +
        "lib,1.0,lib@1.0,double,gap,400,3,2,0,0,0.5,gap/1\nlib,2.0,lib@2.0,double,gap,400,0,0,0,0,,\n" +
        "lib,1.0,lib@1.0,double,deep,400,1,1,0,2,0.1,deep/3\nclosed,,closed,float,gap,50,1,1,0,0,0.2,gap/1\n",
      "machine.csv": "name,value\nbegun,2026-01-31 13:05:00 UTC\ncommand_line,touchstone check --peer lib@all\n",
    },
    [
      recorded("gap/1", "gap", [{ algorithm: "closed", file: "closed_test.cpp", text: "int main() {}" }],
        answer("lib@1.0", "silent", "off by 0.1 of the size"), answer("lib@2.0", "right", ""),
        { ...answer("closed", "silent", "off by 0.2 of the size"), scalar: "float" }),
      recorded("gap/2", "gap", [], answer("lib@1.0", "silent", "off by 0.5 of the size")),
      recorded("deep/3", "deep", [], answer("lib@1.0", "silent", "off by 0.1 of the size")),
    ],
  );
  const file = await fill(process.env.PAGE, join(await mkdtemp(join(tmpdir(), "page-")), "page.html"), bundle_of([results]));
  const { page, complaints } = await open(browser, file);
  const section = page.locator("#wrong-by-version");
  const fields = (row) => section.locator(`tbody tr:nth-child(${row}) td`).allTextContents();
  assert.deepEqual(await fields(1), ["800", "3", "1 + 2 failed"]);
  assert.deepEqual(await fields(2), ["400", "0", "–"]);
  assert.deepEqual(await fields(3), ["50", "1", "–"]);
  await section.getByRole("button", { name: "lib 1.0, gap: 3 of 400 answers wrong, about 2 pairs" }).click();
  const chosen = section.locator(".chosen");
  assert.match(await chosen.locator("h3").textContent(), /lib 1.0, gap/);
  // The worst pair comes first.
  assert.deepEqual(await chosen.locator("select").first().locator("option").allTextContents(), [
    "gap/2: overlapping, off by 0.5 of the size",
    "gap/1: overlapping, off by 0.1 of the size",
  ]);
  assert.equal(await chosen.locator("canvas").count(), 1);
  assert.match(await chosen.textContent(), /query results\/versions\/wrong_pairs.jsonl --id gap\/2 --with exact --peer lib@1.0 --task signed/);
  await chosen.locator("select").first().selectOption({ index: 1 });
  assert.equal(await chosen.locator("canvas").count(), 1);
  // The address brings the same back.
  const address = new URL(page.url()).hash;
  await page.goto("about:blank");
  await page.goto(`file://${file}${address}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  assert.match(await section.locator(".chosen").textContent(), /--id gap\/1/);
  await section.getByRole("button", { name: "closed float, gap" }).click();
  assert.match(await section.locator(".chosen pre.test").textContent(), /int main/);
  assert.match(await page.locator("footer").textContent(), /2026-01-31 13:05:00 UTC, touchstone check --peer lib@all/);
  assert.deepEqual(complaints, []);
  await page.close();
});

// Pages to test, and a browser to open them in.
import { readFile, writeFile } from "node:fs/promises";
import { deflateSync } from "node:zlib";
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

export const browser_file = process.env.CHROMIUM ?? "/usr/bin/chromium";
export const has_browser = () => existsSync(browser_file);

// The one limit of all that the tests wait for. It is there for what never comes: what comes takes seconds.
export const longest_wait = 5 * 60_000;

// Waits until a state holds.
export async function until(holds, what) {
  const end = Date.now() + longest_wait;
  while (!(await holds())) {
    if (Date.now() > end) throw new Error(`it never came: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

export const launch = () =>
  chromium.launch({
    timeout: longest_wait,
    executablePath: browser_file,
    args: [
      "--no-sandbox",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      // It ends the process that draws where that takes long, and pictures in software take long on a busy machine.
      "--disable-gpu-watchdog",
    ],
  });

// Opens a page from the disk. `complaints` collects all that the browser says about it.
export async function open(browser, file, hash = "", options = {}) {
  const page = await browser.newPage({ viewport: { width: 1200, height: 900 }, ...options });
  page.setDefaultTimeout(longest_wait);
  const complaints = [];
  page.on("console", (message) => {
    // Drawing in software is slow, which the browser mentions.
    if (
      ["error", "warning"].includes(message.type()) &&
      !/GPU stall|GL Driver/.test(message.text())
    ) {
      complaints.push(message.text());
    }
  });
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("dialog", (dialog) => {
    complaints.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  await page.goto(`file://${file}${hash}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  return { page, complaints };
}

// Puts data into a built page, as the program does.
export async function fill(built, out, bundle) {
  const page = await readFile(built, "utf8");
  const packed = deflateSync(JSON.stringify(bundle)).toString("base64");
  await writeFile(
    out,
    page.replace("<!--BUNDLE-->", () => packed),
  );
  return out;
}

export const bundle_of = (results, scenes = []) => ({
  format: 1,
  made: { version: "0", commit: "none", tree: "clean", date: "2000-01-01", command: "touchstone report" },
  origins: { gjk: "ours" },
  results,
  scenes,
});

export const folder_of = (name, files, cases = []) => ({
  name,
  folder: `results/${name}`,
  files,
  cases,
  notes: [],
});

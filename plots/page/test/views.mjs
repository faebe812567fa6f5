// Takes a small picture of each view of a page, or of one: node test/views.mjs REPORT.html FOLDER [NAME]
import { mkdir, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { launch, open } from "./pages.mjs";
import { small_png } from "./small_png.mjs";

const [report, folder, only] = process.argv.slice(2);
if (!folder) throw new Error("usage: node test/views.mjs REPORT.html FOLDER [NAME]");
const most_bytes = 60_000; // of a picture
const least_bytes = 2_000; // less is a figure that is not drawn yet
const most_bytes_of_all = 500_000;

async function open_pair(page) {
  const pair = page.locator("details.pair").first();
  await pair.locator("summary").first().click();
  await pair.getByText("show the gap").click();
}

const open_version = (page) => page.locator('#wrong-by-version button[aria-label^="mujoco 3.9.0, random:"]').click();

const choose_axis = (page, axis) => page.locator("#stress-breaks select").first().selectOption({ label: axis });

async function play(page, name, frame) {
  const scene = page.locator(`#${name}-playback`);
  await scene.getByText("Open the scene").click();
  await scene.getByLabel("frame", { exact: true }).fill(String(frame));
  return scene;
}

async function play_two(page) {
  const scene = await play(page, "rock-pile", 8);
  await scene.getByLabel("side by side").check();
}

// A view is an element of the page, or its upper part, after what a reader does to see it.
const views = [
  { name: "first_screen", element: "#fastest", height: 860, width: 1240 },
  { name: "versions", element: "#wrong-by-version", height: 1090 },
  { name: "versions_pair", element: "#wrong-by-version .chosen", height: 820, act: open_version },
  { name: "curves", element: "#reference-curves .panels" },
  { name: "winners", element: "#reference-fastest", height: 560 },
  { name: "phases", element: "#reference-phases figure" },
  { name: "trade", element: "#grid-chart figure" },
  { name: "accuracy", element: "#reference-answers", height: 420 },
  { name: "stress_map", element: "#stress-breaks figure", height: 460, act: (page) => choose_axis(page, "aspect") },
  { name: "pair", element: "details.pair[open]", height: 560, act: open_pair },
  { name: "playback", element: "#rock-pile-playback .player", height: 540, act: (page) => play(page, "rock-pile", 8) },
  { name: "comparison", element: "#comparison-ratios figure", height: 460 },
  { name: "curves_dark", element: "#reference-curves .panels", dark: true },
  { name: "phone", element: "#fastest", height: 1300, width: 390 },
  { name: "playback_dark", element: "#rock-pile-playback .player", height: 440, dark: true, act: play_two },
];

await mkdir(folder, { recursive: true });
const browser = await launch();
const reader = await browser.newPage(); // a page that decodes screenshots

async function smaller(screenshot) {
  const { width, height, pixels } = await reader.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const { width, height } = image;
    const canvas = new OffscreenCanvas(width, height).getContext("2d");
    canvas.drawImage(image, 0, 0);
    const bytes = canvas.getImageData(0, 0, width, height).data;
    let text = "";
    for (let i = 0; i < bytes.length; i += 8192)
      text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return { width, height, pixels: btoa(text) };
  }, screenshot.toString("base64"));
  return small_png(width, height, Buffer.from(pixels, "base64"));
}

let bytes_of_all = 0;
for (const { name, element, width = 1040, height = Infinity, dark = false, act } of views) {
  if (only && name !== only) continue;
  const { page, complaints } = await open(browser, report, "", {
    viewport: { width, height: 900 },
    colorScheme: dark ? "dark" : "light",
  });
  await act?.(page);
  const shown = page.locator(element).first();
  await shown.scrollIntoViewIfNeeded();
  // The parts of the page above may still grow, and move it.
  const picture = async () => {
    await page.waitForTimeout(500);
    const box = await shown.evaluate((each) => {
      const { left, top, width, height } = each.getBoundingClientRect();
      return { x: left + scrollX, y: top + scrollY, width, height };
    });
    const clip = {
      x: box.x - 12,
      y: box.y - 4,
      width: box.width + 24,
      height: Math.min(box.height, height) + 8,
    };
    return smaller(await page.screenshot({ fullPage: true, clip }));
  };
  let png = await picture();
  for (let tries = 0; png.length < least_bytes && tries < 20; ++tries) png = await picture();
  if (png.length < least_bytes) throw new Error(`${name} stays empty`);
  const path = join(folder, `${name}.png`);
  await writeFile(path, png);
  bytes_of_all += png.length;
  console.log(`${path}: ${png.length} bytes`);
  if (png.length > most_bytes) throw new Error(`${path} is larger than ${most_bytes} bytes`);
  if (complaints.length > 0) throw new Error(`${name}: ${complaints}`);
  await page.close();
}
await browser.close();
if (bytes_of_all > most_bytes_of_all) throw new Error(`all pictures have ${bytes_of_all} bytes`);

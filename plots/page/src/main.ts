// The script builds the page from the bundle that is in it.
import { show_address } from "./base/anchors";
import { make } from "./base/dom";
import { Slices } from "./base/slices";
import { read_bundle } from "./bundle";
import { playback } from "./scene/playback";
import { compare } from "./sections/compare";
import { fastest } from "./sections/fastest";
import { files } from "./sections/files";
import { speed } from "./sections/speed";
import { about, foot, summary } from "./sections/summary";
import { trade } from "./sections/trade";
import { verdicts } from "./sections/verdicts";
import { versions } from "./sections/versions";
import { Folder } from "./tables/folder";

function contents(sections: HTMLElement[]): HTMLElement {
  const links = sections.map((each) => {
    const title = each.querySelector("h2")?.firstChild?.textContent ?? "";
    return make("li", {}, make("a", { href: `#${each.id}` }, title));
  });
  const list = make("ul", {}, ...links);
  const few = 9; // they have one line
  const shown = links.length <= few ? list : make("details", {}, make("summary", {}, "Contents"), list);
  return make("nav", { "aria-label": "contents" }, shown);
}

async function build(page: HTMLElement): Promise<void> {
  const slices = new Slices((text) => {
    if (text) page.firstElementChild!.replaceChildren(`${text} …`);
  });
  await slices.begin("Reading the results");
  const bundle = await read_bundle(document.getElementById("bundle")!, slices);
  const folders = bundle.results.map((results) => new Folder(results));
  const names = [
    ...folders.map((folder) => folder.name),
    ...bundle.scenes.map((scene) => scene.name),
  ];
  document.title = `Touchstone: ${names.join(", ")}`;
  const makers: (() => HTMLElement | null)[] = [
    () => versions(folders),
    () => fastest(bundle, folders),
    () => summary(bundle, folders),
    () => compare(folders),
    ...folders.flatMap((folder) => [speed, trade, verdicts].map((of) => () => of(folder))),
    ...bundle.scenes.map((scene) => () => playback(scene)),
    ...folders.map((folder) => () => files(folder)),
    () => about(bundle, folders),
  ];
  const sections: HTMLElement[] = [];
  await slices.begin("Drawing the results");
  for (const maker of makers) {
    const made = maker();
    if (!made) continue;
    // Each section is laid out by itself: all of them at once would hold the page for long.
    if (sections.length === 0) page.replaceChildren(make("h1", {}, "Touchstone"), made);
    else page.append(made);
    sections.push(made);
    await slices.begin("");
  }
  page.firstElementChild?.after(contents(sections));
  page.append(foot(bundle, folders));
  document.documentElement.dataset["ready"] = "yes";
  window.addEventListener("hashchange", show_address);
  show_address();
}

const page = document.getElementById("page")!;
build(page).catch((error: unknown) => {
  page.replaceChildren(
    make("p", { class: "wrong" }, `The page could not be drawn: ${String(error)}`),
  );
  document.documentElement.dataset["ready"] = "failed";
});

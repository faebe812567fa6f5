// The summary says what was measured, where, and what came out.
import type { Bundle } from "../bundle";
import { make, quiet } from "../base/dom";
import { part, section } from "../base/section";
import type { Folder } from "../tables/folder";
import { answers } from "./answers";

export function summary(bundle: Bundle, folders: Folder[]): HTMLElement {
  const { version, commit, tree, date } = bundle.made;
  return section(
    "Summary",
    ...folders.map((folder) =>
      part(
        `${folder.anchor}-overview`,
        folder.name,
        make("p", {}, measured(folder)),
        make("ul", {}, ...answers(folder, bundle.origins).map((text) => make("li", {}, text))),
        ...folder.results.notes.map((note) => make("p", { class: "wrong" }, note)),
        hashes(folder),
        make("details", {}, make("summary", {}, "Machine and build"), folder.grid("machine.csv")),
      ),
    ),
    bundle.scenes.length > 0 ? recordings(bundle) : null,
    quiet(
      `Made by Touchstone ${version} (${commit}, ${tree}) on ${date}. Sections, tables, rows and pairs can be linked to: ` +
        "their addresses are behind the signs ¶ and the numbers of rows. The address of a row with - and a " +
        "column's name behind it is that of one field.",
    ),
  );
}

function measured(folder: Folder): string {
  const fact = (name: string): string => folder.fact(name) || "unknown";
  const campaign = folder.fact("campaign");
  if (!folder.has("machine.csv"))
    return `In ${folder.results.folder}, which does not say where it was measured.`;
  const commit = fact("commit").slice(0, 12);
  const begun = folder.fact("begun");
  return (
    `${campaign ? `Campaign ${campaign}, in` : "In"} ${folder.results.folder}; measured on ${fact("processor")}, ` +
    `${fact("cores_online")} cores, ${fact("kernel")}, hypervisor ${fact("hypervisor")}; ${fact("compiler")}, ` +
    `${fact("instructions_in_use")}; source ${commit} (${fact("tree")})${begun ? `; begun on ${begun}` : ""}.`
  );
}

function hashes(folder: Folder): HTMLElement | null {
  const scenes = folder.scenes();
  if (scenes.length === 0) return null;
  return hash_table("Hashes of the scenes", scenes);
}

const recordings = (bundle: Bundle): HTMLElement =>
  hash_table(
    "Scenes to play",
    bundle.scenes.map((scene): [string, string] => [`${scene.name}, ${scene.source}`, scene.hash]),
  );

const hash_table = (title: string, rows: [string, string][]): HTMLElement =>
  make(
    "details",
    { open: rows.length <= 12 },
    make("summary", {}, title),
    make(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": title },
      make(
        "table",
        {},
        make(
          "tbody",
          {},
          ...rows.map(([name, hash]) =>
            make(
              "tr",
              {},
              make("th", { scope: "row" }, name),
              make("td", {}, make("code", {}, hash)),
            ),
          ),
        ),
      ),
    ),
  );

// The summary says what came out of each folder. What names the run, and where it was made, is folded at the end of the page.
import type { Bundle } from "../bundle";
import { make, quiet } from "../base/dom";
import { part, section } from "../base/section";
import type { Folder } from "../tables/folder";
import { answers } from "./answers";

export const summary = (bundle: Bundle, folders: Folder[]): HTMLElement | null =>
  folders.length === 0
    ? null
    : section(
        "Summary",
        ...folders.map((folder) =>
          part(
            `${folder.anchor}-overview`,
            folder.name,
            make("ul", {}, ...answers(folder, bundle.origins, bundle.approximate).map((text) => make("li", {}, text))),
            ...folder.results.notes.map((note) => make("p", { class: "wrong" }, note)),
          ),
        ),
      );

export function about({ made, scenes }: Bundle, folders: Folder[]): HTMLElement {
  const played = scenes.map((scene): [string, string] => [`${scene.name}, ${scene.source}`, scene.hash]);
  return section(
    "About this page",
    make(
      "details",
      {},
      make("summary", {}, "Machines, builds, hashes of scenes, permalinks"),
      quiet(
        `Made by Touchstone ${made.version} (${made.commit}, ${made.tree}) on ${made.date}. Every ¶ and row number is a ` +
          "permalink; #TABLE-row-N-COLUMN is that of one field.",
      ),
      ...folders.flatMap((folder) => [
        make("h3", {}, folder.name),
        make("p", {}, measured(folder)),
        hash_table(`Scenes of ${folder.name}`, folder.scenes()),
        folder.grid("machine.csv"),
      ]),
      hash_table("Scenes to play", played),
    ),
  );
}

function measured(folder: Folder): string {
  const fact = (name: string): string => folder.fact(name) || "unknown";
  const campaign = folder.fact("campaign");
  const where = `${campaign ? `Campaign ${campaign}, in` : "In"} ${folder.results.folder}`;
  if (!folder.has("machine.csv")) return `${where}, which does not say where it was measured.`;
  const begun = folder.fact("begun");
  const facts = [
    fact("processor"),
    `${fact("cores_online")} cores`,
    fact("instructions_in_use"),
    fact("kernel"),
    fact("compiler"),
    `source ${fact("commit").slice(0, 12)} (${fact("tree")})`,
  ];
  return `${where}. Measured on ${facts.join(", ")}${begun ? `, on ${begun}` : ""}.`;
}

const hash_table = (title: string, rows: [string, string][]): HTMLElement | null =>
  rows.length === 0
    ? null
    : make(
        "div",
        { class: "scroll", tabindex: 0, role: "region", "aria-label": title },
        make(
          "table",
          {},
          make("caption", {}, title),
          make(
            "tbody",
            {},
            ...rows.map(([name, hash]) =>
              make("tr", {}, make("th", { scope: "row" }, name), make("td", {}, make("code", {}, hash))),
            ),
          ),
        ),
      );

// When and by which commands the page and its results were made.
export function foot({ made }: Bundle, folders: Folder[]): HTMLElement {
  const measured = folders.flatMap((folder) => {
    const begun = folder.fact("begun"),
      command = folder.fact("command_line");
    if (!begun && !command) return [];
    return [
      make("p", {}, `${folder.name}: ${begun}${begun && command ? ", " : ""}`, command ? make("code", {}, command) : null),
    ];
  });
  return make(
    "footer",
    {},
    make("p", {}, `This page: ${made.date}${made.command ? ", " : ""}`, made.command ? make("code", {}, made.command) : null),
    ...measured,
  );
}

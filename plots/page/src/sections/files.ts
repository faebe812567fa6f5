// This section shows the files that no other part shows. Their tables are filled when they are opened, since some
// are long.
import { answer_for, element_of } from "../base/anchors";
import { quiet } from "../base/dom";
import { folded, section } from "../base/section";
import type { Folder } from "../tables/folder";

export function files(folder: Folder): HTMLElement | null {
  const rest = folder.rest().filter((file) => file !== "machine.csv"); // that is in the last section
  if (rest.length === 0) return null;
  return section(
    `${folder.name}: other tables`,
    quiet("All other files of the folder."),
    ...rest.map((file) => unfolding(folder, file)),
  );
}

function unfolding(folder: Folder, file: string): HTMLElement {
  const anchor = folder.anchor_of(file);
  const { element, open } = folded(file, () => folder.grid(file));
  element.classList.add("file");
  // Once it is filled, the table answers for itself.
  answer_for(anchor, (rest) => {
    open();
    return element_of(rest === "" ? anchor : `${anchor}-${rest}`);
  });
  return element;
}

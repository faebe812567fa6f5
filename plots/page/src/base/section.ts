// Sections and parts have anchors, so that they can be linked to.
import { fresh_anchor } from "./anchors";
import { make } from "./dom";

type Child = Node | string | null;

export function section(title: string, ...children: Child[]): HTMLElement {
  return titled("h2", fresh_anchor(title), title, children);
}

// The anchor is shorter than the title.
export function section_at(anchor: string, title: string, ...children: Child[]): HTMLElement {
  return titled("h2", fresh_anchor(anchor), title, children);
}

export function part(id: string, title: string, ...children: Child[]): HTMLElement {
  return titled("h3", id, title, children);
}

function titled(level: "h2" | "h3", id: string, title: string, children: Child[]): HTMLElement {
  const link = make("a", { href: `#${id}`, class: "link", "aria-label": `link to ${title}` }, "¶");
  return make("section", { id }, make(level, {}, title, link), ...children);
}

// A folded part is filled when it is first opened, so that long files cost nothing until then.
export function folded(
  title: string,
  fill: () => Node,
): { element: HTMLDetailsElement; open: () => void } {
  const element = make("details", {}, make("summary", {}, title));
  let filled = false;
  const fill_once = (): void => {
    if (!filled) element.append(fill());
    filled = true;
  };
  element.addEventListener("toggle", () => {
    if (element.open) fill_once();
  });
  const open = (): void => {
    fill_once();
    element.open = true;
  };
  return { element, open };
}

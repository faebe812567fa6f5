// An address after "#" may name what is not drawn yet: a row that a table does not show, or a pair that is folded
// away. Whoever draws such things says here how to show them.

const taken = new Set<string>();
const shown_by = new Map<string, (rest: string) => Element | null>();

const plain = (text: string): string =>
  text
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "-")
    .replace(/^-|-$/g, "");

// The name can stand in an address, and nobody else has it.
export function fresh_anchor(text: string): string {
  const start = plain(text) || "part";
  let anchor = start;
  for (let number = 2; taken.has(anchor); ++number) anchor = `${start}-${number}`;
  taken.add(anchor);
  return anchor;
}

// `show` gets what follows `prefix` in an address, and gives the element that is meant.
export function answer_for(prefix: string, show: (rest: string) => Element | null): void {
  shown_by.set(prefix, show);
}

const restored_by = new Map<string, (state: URLSearchParams) => void>();

// An address "#anchor?name=value" has the state of a part.
export function restore_by(anchor: string, restore: (state: URLSearchParams) => void): void {
  restored_by.set(anchor, restore);
}

// This is the element that an address means. It is drawn if it was not.
export function element_of(anchor: string): Element | null {
  const present = document.getElementById(anchor);
  if (present) return present;
  for (let end = anchor.length; end > 0; end = anchor.lastIndexOf("-", end - 1)) {
    const show = shown_by.get(anchor.slice(0, end));
    const found = show?.(anchor.slice(end + 1));
    if (found) return found;
  }
  return null;
}

// The page unfolds what holds the element, and moves there.
function reveal(element: Element): void {
  for (const each of document.querySelectorAll(".target")) each.classList.remove("target");
  for (let up: Element | null = element; up; up = up.parentElement) {
    if (up instanceof HTMLDetailsElement) up.open = true;
  }
  element.classList.add("target");
  element.scrollIntoView({ block: element instanceof HTMLTableRowElement ? "center" : "start" });
}

export function show_address(): void {
  let anchor = location.hash.slice(1);
  const mark = anchor.indexOf("?");
  const restore = mark < 0 ? undefined : restored_by.get(anchor.slice(0, mark));
  if (restore) return restore(new URLSearchParams(anchor.slice(mark + 1)));
  try {
    anchor = decodeURIComponent(anchor);
  } catch {
    // An address that somebody cut in the middle of a sign stays as it is.
  }
  const element = anchor ? element_of(anchor) : null;
  if (element) reveal(element);
}

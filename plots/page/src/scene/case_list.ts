// The list has all pairs of a folder. Each is drawn when it is opened.
import { make, quiet } from "../base/dom";
import type { Folder } from "../tables/folder";
import { is_wrong, pair_text } from "../tables/pairs";
import { pair_view, type PairView } from "./pair_view";

export function case_list(folder: Folder): HTMLElement {
  // A browser gives out few canvases: a pair that is opened closes the one before it.
  let open: { details: HTMLDetailsElement; view: PairView; place: HTMLElement } | null = null;
  const close = (): void => {
    if (!open) return;
    open.view.dispose();
    open.place.replaceChildren();
    open.details.open = false;
    open = null;
  };
  const items = folder.pairs.map((pair, number) => {
    const anchor = folder.case_anchor(number);
    const place = make("div");
    const details = make(
      "details",
      { id: anchor, class: "pair" },
      make(
        "summary",
        {},
        pair.answers.some(is_wrong) ? `${pair_text(pair)} ` : `${pair_text(pair)} (${pair.about}) `,
        make("a", { href: `#${anchor}`, class: "link", "aria-label": `link to ${pair.id}` }, "¶"),
      ),
      place,
    );
    details.addEventListener("toggle", () => {
      if (details.open && open?.details !== details) {
        close();
        open = { details, view: pair_view(pair), place };
        place.replaceChildren(open.view.element);
      } else if (!details.open && open?.details === details) {
        close();
      }
    });
    return details;
  });
  const filter = make("input", {
    type: "search",
    placeholder: "filter",
    "aria-label": "filter the pairs",
  });
  filter.addEventListener("input", () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const item of items) {
      const text = item.firstChild?.textContent?.toLowerCase() ?? "";
      item.hidden = !words.every((word) => text.includes(word));
    }
  });
  return make("div", {}, quiet("Open a pair to see it in three dimensions."), filter, ...items);
}

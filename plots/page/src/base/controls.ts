// Buttons and choosers each have a label, which a screen reader reads out.
import { make } from "./dom";

export function button(label: string, pressed: () => void, name?: string): HTMLButtonElement {
  const element = make("button", { type: "button", "aria-label": name }, label);
  element.addEventListener("click", pressed);
  return element;
}

// The button copies a text.
export function copy_button(text: string, label = "copy"): HTMLButtonElement {
  const element = button(label, () => {
    const done = (): void => {
      element.textContent = "copied";
      setTimeout(() => (element.textContent = label), 1500);
    };
    // Pages opened from a disk may not use the clipboard in every browser.
    const by_hand = (): void => void window.prompt("Copy this line", text);
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, by_hand);
    else by_hand();
  });
  element.classList.add("copy");
  return element;
}

// A line of a shell has a button that copies it.
export const command_line = (command: string): HTMLElement =>
  make("p", { class: "command" }, make("code", {}, command), " ", copy_button(command));

const most_at_once = 300;

// The reader chooses one of some texts. `changed` gets its place, since texts may be equal.
export function choice(
  label: string,
  options: string[],
  chosen: number,
  changed: (place: number) => void,
): HTMLLabelElement {
  const list = make("select", {});
  const fill = (): void => {
    const now = list.options.length > 0 ? Number(list.value) : chosen;
    list.replaceChildren(
      ...options.map((option, place) => make("option", { value: place }, option || "(all)")),
    );
    list.value = String(now);
  };
  if (options.length <= most_at_once) {
    fill();
  } else {
    // Thousands of options take a second to lay out: they come when somebody turns to the list.
    list.append(make("option", { value: chosen }, options[chosen]));
    list.addEventListener("focus", fill, { once: true });
  }
  list.addEventListener("change", () => changed(Number(list.value)));
  return make("label", {}, `${label} `, list);
}

export function checkbox(
  label: string,
  checked: boolean,
  changed: (checked: boolean) => void,
): { element: HTMLLabelElement; set: (checked: boolean) => void } {
  const box = make("input", { type: "checkbox", checked });
  box.addEventListener("change", () => changed(box.checked));
  return {
    element: make("label", {}, box, ` ${label}`),
    set: (value) => (box.checked = value),
  };
}

export const controls = (...children: (Node | null)[]): HTMLElement =>
  make("div", { class: "controls" }, ...children);

// Each algorithm has a switch. Two buttons switch all of them on, or none. They are folded, since they would fill a screen.
export function switches(
  legend: string,
  names: string[],
  hidden: Set<string>,
  changed: () => void,
): HTMLElement {
  const boxes = names.map((name) =>
    checkbox(name, !hidden.has(name), (on) => {
      if (on) hidden.delete(name);
      else hidden.add(name);
      changed();
    }),
  );
  const set_all = (on: boolean): void => {
    for (const name of names) {
      if (on) hidden.delete(name);
      else hidden.add(name);
    }
    for (const box of boxes) box.set(on);
    changed();
  };
  return make(
    "details",
    {},
    make("summary", {}, `${legend}: choose among ${names.length}`),
    make(
      "fieldset",
      { "aria-label": legend },
      button("all", () => set_all(true), `${legend}: all`),
      button("none", () => set_all(false), `${legend}: none`),
      ...boxes.map((box) => box.element),
    ),
  );
}

// The chart shows what is chosen, and the first to begin with.
export function chosen_chart(
  label: string,
  options: string[],
  chart: (place: number) => Element,
): HTMLElement[] {
  const figure = make("figure", { class: "scroll" });
  const show = (place: number): void => figure.replaceChildren(chart(place));
  show(0);
  return [controls(choice(label, options, 0, show)), figure];
}

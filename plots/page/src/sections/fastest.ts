// The first screen: who is fastest, and who is right. It has a line for each question, the race of one, and its inputs.
// What the reader chooses is in the address.
import { restore_by } from "../base/anchors";
import { choice, controls } from "../base/controls";
import { make, quiet } from "../base/dom";
import { interval_text, number_text } from "../base/numbers";
import { section_at } from "../base/section";
import type { Bundle } from "../bundle";
import { race_chart, times_text } from "../charts/race";
import { on_click } from "../charts/style";
import { has_ratio, input_chart, ratio_domain, strip, strip_axis } from "../charts/strips";
import {
  faults_text,
  inputs_of,
  is_too_noisy,
  is_library,
  is_ours,
  leads_text,
  standings,
  type Entry,
  type Input,
} from "../tables/contest";
import type { Folder } from "../tables/folder";
import { distinct, grouped } from "../tables/set";

type State = Record<string, string>;
const everything = "all";

const anchor = "fastest";

// A filter has a name in the address, a label, and the value of an input or of an entry.
const of_input: [string, string, (input: Input) => string][] = [
  ["task", "Question", ({ question }) => question],
  ["scene", "Scene", ({ scene }) => scene],
  ["bodies", "Bodies", ({ bodies }) => bodies],
  ["kind", "Kind", ({ kind }) => kind],
  ["threads", "Threads", ({ threads }) => threads],
];
const who = new Map<string, (entry: Entry) => boolean>([
  ["ours and libraries", () => true],
  ["ours alone", ({ origin }) => is_ours(origin)],
  ["libraries alone", ({ origin }) => is_library(origin)],
]);

export function fastest(bundle: Bundle, folders: Folder[]): HTMLElement | null {
  const races = folders
    .map((folder) => ({ folder, inputs: inputs_of(folder, bundle.approximate) }))
    .filter(({ inputs }) => inputs.length > 0);
  if (races.length === 0) return null;
  let state: State = {};
  const place = make("div", { class: "fastest" });

  const wanted = (): { folder: Folder; inputs: Input[] } =>
    races.find(({ folder }) => folder.name === state["results"]) ?? races[0]!;

  function change(next: State, kept = true): void {
    state = kept ? { ...state, ...next } : next;
    const told = new URLSearchParams(Object.entries(state).filter(([, value]) => value !== ""));
    history.replaceState(null, "", `#${anchor}?${told}`);
    draw();
  }

  function draw(): void {
    const unfolded = place.querySelector("details")?.open ?? false;
    const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset["key"] : undefined;
    const { inputs } = wanted();
    const groups = grouped(inputs, ({ line }) => line);
    const question = groups.has(state["question"] ?? "") ? state["question"]! : [...groups.keys()][0]!;
    place.replaceChildren(
      races.length > 1 ? choose_results() : "",
      question_list(groups, question, facts_of(wanted().folder), (chosen) =>
        change({ results: state["results"] ?? "", question: chosen }, false),
      ),
      make(
        "p",
        { class: "faults" },
        is_too_noisy(inputs)
          ? make("span", { class: "wrong" }, "Too noisy to compare: most samples were disturbed. ")
          : null,
        faults_text(inputs).join(" "),
      ),
      ...race(groups.get(question)!, state, change),
    );
    if (unfolded) place.querySelector("details")?.setAttribute("open", "");
    if (focused) place.querySelector<HTMLElement>(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  }

  const choose_results = (): HTMLElement =>
    controls(
      choice(
        "Results",
        races.map(({ folder }) => folder.name),
        races.indexOf(wanted() as (typeof races)[number]),
        (chosen) => change({ results: races[chosen]!.folder.name }, false),
      ),
    );

  draw();
  restore_by(anchor, (given) => {
    state = Object.fromEntries(given);
    draw();
  });
  let width = innerWidth;
  window.addEventListener("resize", () => {
    if (innerWidth !== width) draw();
    width = innerWidth;
  });
  return section_at(anchor, "Which is fastest, and is it right?", place);
}

const page_width = (): number => Math.max(300, Math.min(innerWidth, 1216) - 42);
const is_narrow = (): boolean => innerWidth < 700;

// Each question has a strip: the best of ours against the best library, a mark for each input.
function question_list(
  groups: Map<string, Input[]>,
  chosen: string,
  facts: string,
  choose: (question: string) => void,
): HTMLElement {
  const domain = ratio_domain([...groups.values()].flat());
  const width = is_narrow() ? page_width() - 20 : Math.round(page_width() * 0.34);
  const lines = [...groups].map(([question, inputs]) => {
    const button = make(
      "button",
      { type: "button", class: "question", "aria-pressed": String(question === chosen), "data-key": question },
      make("span", { class: "name" }, question),
      strip(inputs, domain, width),
      make("span", { class: "told" }, `${leads_text(inputs)}${middle_text(inputs)}`),
    );
    button.addEventListener("click", () => choose(question));
    return make("li", {}, button);
  });
  return make(
    "div",
    { class: "questions" },
    make(
      "div",
      { class: "question head quiet" },
      make("span", {}, facts),
      strip_axis(domain, width),
      make("span", {}, "time of the fastest library / of the fastest of ours"),
    ),
    make("ul", {}, ...lines),
  );
}

const facts_of = (folder: Folder): string =>
  [folder.name, folder.fact("processor"), folder.fact("instructions_in_use")].filter(Boolean).join(", ");

// The input in the middle stands for all, with the least and the greatest.
function middle_text(inputs: Input[]): string {
  const ratios = inputs.filter(has_ratio).map(({ ratio }) => ratio).sort((a, b) => a - b);
  if (ratios.length === 0) return "";
  const half = (ratios.length - 1) / 2;
  const middle = Math.sqrt(ratios[Math.floor(half)]! * ratios[Math.ceil(half)]!);
  if (ratios.length === 1) return `; ${times_text(middle)}`;
  return `; median ${times_text(middle)} (${number_text(ratios[0]!)} … ${number_text(ratios[ratios.length - 1]!)})`;
}

function race(inputs: Input[], given: State, change: (next: State) => void): HTMLElement[] {
  // Times of several questions, or numbers of threads, are not averaged unless the reader asks for it.
  const [fewest = ""] = distinct(inputs.map(({ threads }) => threads)).sort((a, b) => Number(a) - Number(b));
  const state: State = { task: inputs[0]!.question, threads: fewest, ...given };
  const matching = (without = ""): Input[] =>
    inputs.filter((input) =>
      of_input.every(
        ([name, , value]) =>
          name === without || !state[name] || !inputs.some((each) => value(each) === state[name]) || value(input) === state[name],
      ),
    );
  // Where libraries take part, inputs without one would leave them all out of the mean.
  const all = matching();
  const with_library = all.filter(({ lead }) => lead !== "no library");
  const shown = with_library.length > 0 ? with_library : all;
  const scalars = distinct(inputs.flatMap(({ entries }) => entries.map(({ scalar }) => scalar))).filter(Boolean);
  const entries = shown
    .flatMap((input) => input.entries)
    .filter(who.get(state["show"] ?? "") ?? (() => true))
    .filter(({ scalar }) => !state["scalar"] || scalar === "" || scalar === state["scalar"]);
  const filter = (name: string, label: string, options: string[], all: string): Node | null => {
    if (options.length < 2) return null;
    const values = [everything, ...options];
    const chosen = Math.max(0, values.indexOf(state[name] ?? ""));
    const label_of = choice(label, [all, ...options], chosen, (place) => change({ [name]: values[place]! }));
    label_of.querySelector("select")!.dataset["key"] = name;
    return label_of;
  };
  const filters = controls(
    ...of_input.map(([name, label, value]) =>
      filter(name, label, distinct(matching(name).map(value)).filter(Boolean), "all"),
    ),
    filter("show", "Show", [...who.keys()].slice(1), [...who.keys()][0]!),
    filter("scalar", "Numbers", scalars, "double and float"),
  );
  const narrow = is_narrow();
  const width = page_width();
  const left = narrow ? width : Math.round(width * 0.57);
  const right = narrow ? width : width - left - 36;
  const pick = (input: Input): void =>
    change(Object.fromEntries(of_input.map(([name, , value]) => [name, value(input)])));
  return [
    narrow ? make("details", {}, make("summary", {}, "Filters"), filters) : filters,
    make(
      "div",
      { class: "beside" },
      make(
        "figure",
        { class: "race", style: `width: ${left}px` },
        make("figcaption", {}, first_text(shown)),
        entries.length > 0
          ? race_chart(standings(entries), shown.length, left)
          : quiet("No algorithm is left. Choose less narrowly."),
      ),
      make(
        "figure",
        { class: inputs.length > 36 ? "inputs long" : "inputs", style: `width: ${right}px` },
        make("figcaption", {}, "Fastest library over fastest of ours, by input"),
        on_click<Input>(input_chart(inputs, right), pick),
      ),
    ),
    quiet(
      "Blue: ours. Orange: libraries. Thin lines: 95 % intervals. ✕: wrong, or failed. ≈: inexact, or approximate by design; " +
        "neither can win. Pale, below the dotted line: measured in some of the inputs only. Hollow at the right: equal. " +
        "Click an input to see it alone.",
    ),
  ];
}

// Says who is first. Two that their interval does not tell apart are equal.
function first_text(inputs: Input[]): string {
  if (inputs.length !== 1) return `Time over that of the fastest, geometric mean of ${inputs.length} inputs`;
  const { first, name } = inputs[0]!;
  if (!first || first.text("runner_up") === "") return name;
  const [winner, next] = [first.text("winner"), first.text("runner_up")];
  const low = first.number("ratio_low");
  if (!(low > 1)) return `${name}: ${winner} = ${next}, which the interval of their ratio does not tell apart`;
  const interval = interval_text(low, first.number("ratio_high"));
  return `${name}: ${winner} is ${times_text(first.number("ratio"))} (${interval}) as fast as ${next}`;
}

// Who was wrong in which version: a row for each version of a library, a column for each family of pairs. What is wrong in
// a cell is drawn when the cell is chosen, with the proof, and the test that shows it. What is chosen is in the address.
import { restore_by } from "../base/anchors";
import { choice, command_line, controls, copy_button } from "../base/controls";
import { make, quiet } from "../base/dom";
import { count_text, counted, number_text } from "../base/numbers";
import { section_at } from "../base/section";
import type { AnswerView, CaseView } from "../bundle";
import { pair_view, type PairView } from "../scene/pair_view";
import type { Folder } from "../tables/folder";
import { is_wrong } from "../tables/pairs";
import { distinct } from "../tables/set";

const file = "versions.csv";

// The answers of a version to the pairs of a family.
interface Cell {
  folder: Folder;
  library: string; // with its version, and float where it is not in double
  algorithm: string;
  scalar: string;
  family: string;
  answers: number;
  wrong: number;
  wrong_pairs: number;
  gave_up: number;
  failed: number;
  worst: number;
}

function cells_of(folder: Folder): Cell[] {
  return folder.rows(file).map((row) => ({
    folder,
    library: [row.text("library"), row.text("version"), row.text("scalar") === "float" ? "float" : ""]
      .filter(Boolean)
      .join(" "),
    algorithm: row.text("algorithm"),
    scalar: row.text("scalar"),
    family: row.text("group"),
    answers: row.number("answers"),
    wrong: row.number("wrong"),
    wrong_pairs: row.number("wrong_pairs"),
    gave_up: row.number("gave_up"),
    failed: row.number("failed"),
    worst: row.number("worst"),
  }));
}

// The pairs of a cell that were kept, each with the wrong answer of the version first, then with those of its other
// versions, and last with those of the algorithms that were asked when the page was made.
function pairs_of(cell: Cell): CaseView[] {
  const is_of_cell = (answer: AnswerView): boolean =>
    answer.algorithm === cell.algorithm && answer.scalar === cell.scalar && is_wrong(answer);
  const error = ({ why }: AnswerView): number => Number(/[\d.e+-]+/.exec(why)?.[0] ?? 0);
  const place = (answer: AnswerView): number => (is_of_cell(answer) ? 0 : 1);
  return cell.folder.recorded
    .filter(({ recorded }) => recorded?.group === cell.family && recorded.answers.some(is_of_cell))
    .map((pair) => {
      const recorded = [...pair.recorded!.answers].sort((x, y) => place(x) - place(y));
      const asked = pair.answers.filter((answer) =>
        recorded.every(({ algorithm, scalar, task }) => answer.algorithm !== algorithm || answer.scalar !== scalar || answer.task !== task),
      );
      return { ...pair, answers: [...recorded, ...asked] };
    })
    .sort((x, y) => error(y.answers[0]!) - error(x.answers[0]!));
}

const told = ({ answers, wrong, wrong_pairs, gave_up, failed, worst }: Cell): string =>
  [
    `${count_text(wrong)} of ${counted(answers, "answer")} wrong, about ${counted(wrong_pairs, "pair")}`,
    wrong > 0 ? `the worst by ${number_text(worst)} of the size` : "",
    gave_up > 0 ? `${count_text(gave_up)} given up` : "",
    failed > 0 ? `${count_text(failed)} crashed, hung or garbage` : "",
  ]
    .filter(Boolean)
    .join("; ");

// The command that asks about the pair again, the exact answer beside it.
function command_of({ folder, algorithm, scalar }: Cell, { id, source, answers }: CaseView): string {
  const who = algorithm.includes("@") ? `--with exact --peer ${algorithm}` : `--with exact,${algorithm}`;
  return (
    `./touchstone query ${folder.results.folder}/${source} --id ${id} ${who} ` +
    `--task ${answers[0]!.task} --scalar ${scalar}`
  );
}

// It is folded, so that the picture is near.
function test_of({ algorithm }: Cell, pair: CaseView): HTMLElement {
  const test = pair.recorded?.tests.find((each) => each.algorithm === algorithm);
  const [what, text] = test
    ? [`The test to paste, ${test.file}`, test.text]
    : ["The case to paste, as JSON", pair.line];
  return make(
    "details",
    {},
    make("summary", {}, what),
    copy_button(text),
    make("pre", { class: "test", tabindex: 0, role: "region", "aria-label": what }, text),
  );
}

export function versions(folders: Folder[]): HTMLElement | null {
  const cells = folders.flatMap(cells_of);
  if (cells.length === 0) return null;
  const anchor = "wrong-by-version";
  const families = distinct(cells.map(({ family }) => family));
  const place = make("div", { class: "chosen", "aria-live": "polite" });
  const buttons = new Map<Cell, HTMLButtonElement>();
  let view: PairView | null = null;

  function show(cell: Cell, number = 0): void {
    for (const [each, element] of buttons) element.ariaPressed = String(each === cell);
    view?.dispose();
    const pairs = pairs_of(cell);
    const pair = pairs[number] ?? pairs[0];
    const state = { library: cell.library, family: cell.family, pair: String(pairs.indexOf(pair!)) };
    history.replaceState(null, "", `#${anchor}?${new URLSearchParams(state)}`);
    const title = make("h3", {}, `${cell.library}, ${cell.family}`);
    if (!pair) {
      view = null;
      place.replaceChildren(title, make("p", {}, `${told(cell)}. No pair of it was kept.`));
      return;
    }
    view = pair_view(pair);
    const names = pairs.map(({ id, answers }) => `${id}: ${answers[0]!.answer}, ${answers[0]!.why}`);
    place.replaceChildren(
      title,
      make("p", {}, `${told(cell)}.`),
      controls(
        choice(`Pair (${counted(pairs.length, "pair")} kept, the worst first)`, names, pairs.indexOf(pair), (chosen) =>
          show(cell, chosen),
        ),
      ),
      quiet("This command asks it again, beside the exact answer:"),
      command_line(command_of(cell, pair)),
      test_of(cell, pair),
      view.element,
    );
  }

  function field(own: Cell | undefined): HTMLElement {
    if (!own) return make("td", { class: "none" }, "–");
    const bad = own.wrong + own.failed;
    if (bad === 0) return make("td", { class: "fine", title: told(own) }, "0");
    // From a thousandth of the answers to all of them.
    const share = Math.min(1, Math.max(0, 1 + Math.log10(bad / own.answers) / 3));
    const press = make(
      "button",
      { type: "button", "aria-pressed": "false", "aria-label": `${own.library}, ${own.family}: ${told(own)}` },
      count_text(own.wrong),
      own.failed > 0 ? make("small", {}, ` + ${count_text(own.failed)} failed`) : null,
    );
    press.addEventListener("click", () => {
      show(own);
      place.scrollIntoView({ block: "nearest" });
    });
    buttons.set(own, press);
    return make("td", { class: "bad", title: told(own), style: `--strength: ${Math.round(12 + 43 * share)}%` }, press);
  }

  const rows = distinct(cells.map(({ library }) => library)).map((library) => {
    const own = cells.filter((cell) => cell.library === library);
    const sum = (of: (cell: Cell) => number): string => count_text(own.reduce((all, cell) => all + of(cell), 0));
    return make(
      "tr",
      {},
      make("th", { scope: "row" }, library),
      make("td", { class: "number" }, sum(({ answers }) => answers)),
      ...families.map((family) => field(own.find((cell) => cell.family === family))),
    );
  });
  restore_by(anchor, (given) => {
    const meant = [...buttons.keys()].find(
      ({ library, family }) => library === given.get("library") && family === given.get("family"),
    );
    if (!meant) return;
    show(meant, Number(given.get("pair")));
    place.scrollIntoView({ block: "nearest" });
  });
  return section_at(
    anchor,
    "Who was wrong, in which version",
    quiet(
      "A row is a version of a library, a column a family of pairs, a number the wrong answers: on the other side of contact, " +
        "or a distance or depth off, by more than a ten-thousandth of the pair's size. Exact arithmetic says what is right. " +
        "A red number opens its pairs.",
    ),
    make(
      "div",
      { class: "scroll matrices", tabindex: 0, role: "region", "aria-label": "wrong answers by version and family" },
      make(
        "table",
        { class: "matrix versions" },
        make(
          "thead",
          {},
          make(
            "tr",
            {},
            make("td"),
            ...["answers", ...families].map((name) => make("th", { scope: "col", class: "number" }, name)),
          ),
        ),
        make("tbody", {}, ...rows),
      ),
    ),
    place,
  );
}

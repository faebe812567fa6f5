// The pairs of bodies of a folder. Each is one entry, however many algorithms got it wrong and however many files list
// it. The wrong come first, among pairs (the largest errors before others) and among the answers of each.
import { length_text } from "../base/numbers";
import type { AnswerView, CaseView } from "../bundle";
import { distinct, grouped } from "./set";

export interface Pair extends CaseView {
  sources: string[]; // all files that list it
}

const worst_first = ["silent", "crashed", "hung", "approximate"];

export const is_wrong = ({ grade }: AnswerView): boolean => worst_first.includes(grade);

function rank({ grade }: AnswerView): number {
  const place = worst_first.indexOf(grade);
  if (place >= 0) return place;
  return worst_first.length + (grade === "right" ? 1 : 0);
}

export function pairs_of(cases: CaseView[]): Pair[] {
  const groups = grouped(cases, ({ a, b }) => JSON.stringify([a, b]));
  const pairs = [...groups.values()].map((listed) => {
    const [first] = listed as [CaseView, ...CaseView[]];
    const answers = grouped(
      listed.flatMap((each) => each.answers),
      ({ algorithm, scalar, task }) => [algorithm, scalar, task].join("\n"),
    );
    return {
      ...first,
      sources: listed.map(({ source }) => source),
      about: distinct(listed.map(({ about }) => about)).join(", "),
      answers: [...answers.values()].map((same) => same[0]!).sort((x, y) => rank(x) - rank(y)),
    };
  });
  const worst = ({ answers: [first] }: Pair): number => (first ? rank(first) : Infinity);
  return pairs.sort((a, b) => worst(a) - worst(b) || size(b) - size(a));
}

// How far the bodies are apart, or how deep they overlap, metres.
const size = ({ truth: { lower, upper } }: CaseView): number =>
  lower === null || upper === null ? 0 : Math.abs(lower + upper) / 2;

// A run names a pair by its scene, frame and bodies.
const name_of = ({ id }: Pair): string =>
  id.replace(/^(.*)-frame-(\d+)-(\d+)-(\d+)$/, "$1, frame $2, bodies $3 and $4");

// These words say what is so, and who says otherwise.
export function pair_text(pair: Pair): string {
  const { truth, answers } = pair;
  const measure =
    truth.lower === null || truth.upper === null || truth.answer === "touching"
      ? ""
      : ` by ${length_text(size(pair))}`;
  const said = ({ grade, answer }: AnswerView): [string, string] => {
    if (grade === "crashed") return ["crashed", "crashed"];
    if (grade === "hung") return ["did not end", "did not end"];
    const how = grade === "approximate" ? " (approximate by design)" : "";
    return answer === truth.answer
      ? [`is wrong in its numbers${how}`, `are wrong in their numbers${how}`]
      : [`says ${answer}${how}`, `say ${answer}${how}`];
  };
  const wrong = grouped(answers.filter(is_wrong), (answer) => said(answer)[0]);
  const sentences = [...wrong.values()].map((of) => {
    const names = distinct(of.map(({ algorithm }) => algorithm));
    const [one, several] = said(of[0]!);
    return `${names.join(", ")} ${names.length === 1 ? one : several}`;
  });
  return [`${name_of(pair)}: ${truth.answer}${measure}`, ...sentences].join("; ");
}

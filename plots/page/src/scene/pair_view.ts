// This view shows a pair of bodies that somebody got wrong, in three dimensions and in numbers.
import * as THREE from "three";
import type { AnswerView, CaseView } from "../bundle";
import { button, choice, command_line, controls, copy_button } from "../base/controls";
import { make, quiet } from "../base/dom";
import { length_text, number_text } from "../base/numbers";
import { grid } from "../tables/grid";
import { is_wrong } from "../tables/pairs";
import { Table } from "../tables/table";
import { PairDrawing } from "./pair_drawing";
import { Stage } from "./stage";
import { add, beside, times } from "./vectors";

export interface PairView {
  element: HTMLElement;
  dispose: () => void;
}

export function pair_view(pair: CaseView): PairView {
  const stage = Stage.open(`The two bodies of ${pair.id}, which are ${pair.truth.answer}`, true);
  const element = make(
    "div",
    {},
    make("p", {}, truth_text(pair)),
    ...(stage ? drawn(pair, stage) : [quiet("This browser draws nothing in three dimensions.")]),
    answer_table(pair.answers),
    quiet("This command asks all algorithms about it:"),
    command_line(pair.query),
    make(
      "details",
      {},
      make("summary", {}, "The case as JSON"),
      make("pre", {}, pair.line),
      copy_button(pair.line),
    ),
  );
  return { element, dispose: () => stage?.dispose() };
}

function truth_text({ truth }: CaseView): string {
  if (truth.lower === null || truth.upper === null) return `The bodies are ${truth.answer}.`;
  const ends = `from ${truth.lower} to ${truth.upper}`;
  return `The bodies are ${truth.answer}: their signed distance is ${length_text((truth.lower + truth.upper) / 2)} (${ends} m).`;
}

function drawn(pair: CaseView, stage: Stage): HTMLElement[] {
  const drawing = new PairDrawing(pair);
  const group = new THREE.Group();
  stage.scene.add(group);
  // No answer is chosen where none is wrong.
  const first_wrong = pair.answers.findIndex(is_wrong);
  let chosen = first_wrong < 0 ? [] : pair.answers.slice(first_wrong, first_wrong + 1);
  const zoom = power_slider("Enlarged", 7, () => draw());
  const stretch = power_slider("Stretched along the normal", 15, () => draw());

  function draw(): void {
    for (const object of group.children) {
      if (object instanceof THREE.Mesh || object instanceof THREE.Line) object.geometry.dispose();
    }
    group.clear();
    const objects = drawing.objects(chosen, zoom.power(), stretch.power());
    if (objects.length > 0) group.add(...objects);
    stage.draw();
  }

  const set = (zoom_power: number, stretch_power: number): void => {
    zoom.set(zoom_power);
    stretch.set(stretch_power);
    draw();
  };
  const names = [
    "none",
    "all",
    ...pair.answers.map(
      (each) => `${each.algorithm} ${each.scalar} ${each.task}${is_wrong(each) ? " ✗" : ""}`,
    ),
  ];
  draw();
  // A gap is seen as one from the side; somewhat from above, the plane in it is seen too.
  const from = (tilt: number): THREE.Vector3 => {
    const [side, up] = beside(drawing.normal);
    return new THREE.Vector3(...add(add(side, times(0.3, up)), times(tilt, drawing.normal)));
  };
  const look_at_all = (): void => stage.fit(drawing.corners(), from(0.15));
  look_at_all();
  return [
    controls(
      zoom.element,
      stretch.element,
      button("show the gap", () => {
        set(...drawing.powers_for_gap());
        stage.look_at(new THREE.Vector3(0, 0, 0), 1.2, from(0));
      }),
      button("whole bodies", () => {
        set(0, 0);
        look_at_all();
      }),
      choice("What it says", names, first_wrong < 0 ? 0 : first_wrong + 2, (place) => {
        chosen =
          place === 0 ? [] : place === 1 ? pair.answers : pair.answers.slice(place - 2, place - 1);
        draw();
      }),
    ),
    stage.element,
    quiet(
      "Blue: the first body. Orange: the second. Green, with balls and full lines: the exact answer, which is the plane that " +
        "separates them, a point that they share, or the shortest way out (the arrow). The green ball has the depth as its " +
        "radius. Red, with cubes and dashes: what the chosen algorithm says, its witness points and its normal (not stretched). " +
        "Arrow keys turn the view; + and − zoom.",
    ),
  ];
}

// The slider sets a power of ten.
function power_slider(
  label: string,
  most: number,
  changed: () => void,
): { element: HTMLElement; power: () => number; set: (power: number) => void } {
  const input = make("input", { type: "range", min: 0, max: most, step: 0.1, value: 0 });
  const text = make("output", {}, "× 1");
  const tell = (): void => void (text.textContent = `× ${number_text(10 ** Number(input.value))}`);
  input.addEventListener("input", () => {
    tell();
    changed();
  });
  return {
    element: make("label", {}, `${label} `, input, " ", text),
    power: () => Number(input.value),
    set: (power) => {
      input.value = String(power);
      tell();
    },
  };
}

function answer_table(answers: AnswerView[]): HTMLElement {
  const number = (value: number | null): string => (value === null ? "" : String(value));
  const columns = [
    "algorithm",
    "origin",
    "scalar",
    "task",
    "answer",
    "grade",
    "why",
    "status",
    "distance",
    "lower",
    "upper",
  ];
  return grid(
    Table.of(
      columns,
      answers.map((each) => [
        each.algorithm,
        each.origin,
        each.scalar,
        each.task,
        each.answer,
        each.grade === "right" ? "" : `${is_wrong(each) ? "✗ " : ""}${each.grade}`,
        each.why,
        each.status,
        number(each.distance),
        number(each.lower),
        number(each.upper),
      ]),
    ),
  );
}

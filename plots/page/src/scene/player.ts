// The player has the controls of a scene that plays.
import type { Recording } from "../bundle";
import { button, checkbox, choice, controls } from "../base/controls";
import { make, quiet } from "../base/dom";
import { number_text } from "../base/numbers";
import { Slices } from "../base/slices";
import { palettes } from "./body_material";
import { Clock } from "./clock";
import { pair_table } from "./pair_table";
import { Recorded } from "./recorded";
import { SceneView, type Shown } from "./scene_view";
import { Stage } from "./stage";

export interface Player {
  element: HTMLElement;
  dispose: () => void;
}

// These are the points drawn for each of the screen's, on each axis, from the finest to the coarsest.
const sharpnesses = [1, 0.8, 0.65, 0.5];

const milliseconds_until_again = 1000;

export async function player(recording: Recording, slices: Slices): Promise<Player> {
  const recorded = await Recorded.read(recording, slices);
  await slices.begin("making a picture");
  const label = `${recording.name}, played`;
  let stage = Stage.open(label, false);
  if (!stage) {
    // A browser whose drawing process ended starts another one, and draws nothing in three dimensions until then.
    await new Promise((resolve) => setTimeout(resolve, milliseconds_until_again));
    await slices.begin("making a picture");
    stage = Stage.open(label, false);
  }
  if (!stage) {
    return {
      element: quiet("This browser draws nothing in three dimensions."),
      dispose: () => {},
    };
  }
  try {
    const view = await SceneView.open(stage, recording, recorded, slices);
    await slices.begin("making shaders");
    await stage.compile();
    await slices.begin("making controls");
    return controlled(recording, recorded, stage, view);
  } catch (error) {
    stage.dispose();
    throw error;
  }
}

function controlled(
  recording: Recording,
  recorded: Recorded,
  stage: Stage,
  view: SceneView,
): Player {
  const several = recorded.algorithms.length > 1;
  const shown: Shown = {
    frame: 0,
    left: 0,
    right: several ? 1 : 0,
    side_by_side: false,
    boxes: false,
    with_fixed: false,
    structure: -1,
    selected: -1,
  };

  // These texts change while it plays, and so they are not read out.
  const where = make("span", { class: "frame" });
  const rate = make("span", { class: "rate quiet" });
  const pairs = make("div");
  const names = make("div", { class: "names" });
  const slider = make("input", {
    type: "range",
    min: 0,
    max: Math.max(0, recording.frames - 1),
    value: 0,
    "aria-label": "frame",
  });
  slider.addEventListener("input", () => go_to(Number(slider.value)));

  function draw(): void {
    view.show(shown);
    slider.value = String(shown.frame);
    slider.setAttribute("aria-valuetext", `frame ${shown.frame}`);
    where.textContent = `frame ${shown.frame} / ${recording.frames - 1}, ${number_text(shown.frame * recording.time_step)} s`;
  }

  // Tables take longer than frames: while it plays they follow four times a second.
  let told_at = 0,
    only_within = false;
  function tell(): void {
    if (clock.playing && performance.now() - told_at < 250) return;
    told_at = performance.now();
    const rows = (): HTMLElement[] => [...pairs.querySelectorAll<HTMLElement>("tr.pickable")];
    const focused = rows().findIndex((row) => row === document.activeElement);
    pairs.replaceChildren(pair_table(recorded, { ...shown, only_within }, select));
    // A reader who is among the rows stays there.
    if (focused >= 0) rows().slice(0, focused + 1).pop()?.focus();
  }

  function update(change: Partial<Shown>): void {
    Object.assign(shown, change);
    draw();
    tell();
  }

  const go_to = (frame: number): void => {
    const frames = Math.max(1, recording.frames);
    update({ frame: ((frame % frames) + frames) % frames });
  };

  function select(body: number): void {
    const is_body = Number.isInteger(body) && body >= 0 && body < recording.bodies;
    number.value = is_body ? String(body) : "";
    update({ selected: is_body ? body : -1 });
  }

  // Where a frame takes too long, it gets fewer points and triangles, until the scene stands still again.
  let haste = 0;
  function hurry(more: number): void {
    haste = Math.min(more, sharpnesses.length - 1);
    stage.play(clock.playing, sharpnesses[haste]!);
    view.hurry(haste > 0);
  }

  const clock = new Clock(
    recording.time_step,
    (frames) => go_to(shown.frame + frames),
    (frames_a_second) => {
      rate.textContent = `${frames_a_second.toFixed(0)} frames drawn a second`;
      const pace = Math.min(60, 1 / recording.time_step);
      if (frames_a_second < 0.95 * pace) hurry(haste + 1);
    },
    () => stage.element.isConnected,
  );
  const play = button("Play", () => {
    clock.toggle();
    hurry(0);
    play.textContent = clock.playing ? "Pause" : "Play";
    tell();
  });

  const number = make("input", {
    type: "number",
    min: 0,
    max: recording.bodies - 1,
    placeholder: "none",
  });
  number.addEventListener("change", () => select(number.value === "" ? -1 : Number(number.value)));
  pick_by_mouse(stage, (event) => select(view.body_at(event)));

  function show_side_by_side(on: boolean): void {
    stage.show_views(on ? 2 : 1);
    name_views(on);
    update({ side_by_side: on });
  }

  function name_views(two: boolean): void {
    const places = two ? [shown.left, shown.right] : [shown.left];
    names.replaceChildren(
      ...places.map((place) => make("span", {}, recorded.algorithms[place] ?? "boxes alone")),
    );
  }

  const chooser = (label: string, side: "left" | "right"): HTMLElement =>
    choice(label, recorded.algorithms, shown[side], (place) => {
      update({ [side]: place });
      name_views(shown.side_by_side);
    });

  // The scene goes to the next frame in which the two algorithms differ.
  async function next_difference(): Promise<void> {
    const { frame: from, left, right } = shown;
    const slices = new Slices();
    for (let ahead = 1; ahead <= recording.frames; ++ahead) {
      const frame = (from + ahead) % recording.frames;
      if (recorded.disagreements(frame, left, right).differing.length > 0) return go_to(frame);
      await slices.rest();
    }
    where.textContent = "they differ in no frame";
  }

  // The first word of each colour is what it is called.
  const legend = quiet("");
  function wear(place: number): void {
    const palette = palettes[place]!;
    const [apart, boxes, contact] = palette.words;
    const with_what = shown.with_fixed || !recorded.has_fixed_bodies ? "another body" : "a body that is not fixed";
    legend.textContent =
      `${contact}, dotted: touches or overlaps ${with_what}. ${boxes}, striped: its box overlaps that of ${with_what}. ` +
      `${apart}, plain: apart.`;
    view.wear(palette);
  }
  let palette = 0;
  wear(palette);

  name_views(false);
  update({});
  const element = make(
    "div",
    { class: "player" },
    controls(
      button("◀", () => go_to(shown.frame - 1), "one frame back"),
      play,
      button("▶", () => go_to(shown.frame + 1), "one frame on"),
      slider,
      where,
      rate,
    ),
    controls(
      checkbox("boxes", false, (boxes) => update({ boxes })).element,
      recording.structures.length > 0
        ? choice(
            "Structure of",
            ["none", ...recording.structures.map((each) => each.broad)],
            0,
            (place) => update({ structure: place - 1 }),
          )
        : null,
      recorded.algorithms.length > 0 ? chooser("Coloured by", "left") : null,
      several ? chooser("compared with", "right") : null,
      several ? checkbox("side by side", false, show_side_by_side).element : null,
      several ? button("next difference", () => void next_difference()) : null,
      recorded.has_fixed_bodies
        ? checkbox("contacts with fixed bodies", false, (with_fixed) => {
            update({ with_fixed });
            wear(palette);
          }).element
        : null,
      choice(
        "Colours",
        palettes.map((each) => each.name),
        palette,
        (place) => wear((palette = place)),
      ),
      make("label", {}, "Body ", number),
    ),
    legend,
    names,
    stage.element,
    quiet(
      "Click a body, or type its number, to list its pairs; it gets a yellow box. Side by side, magenta boxes mark " +
        "bodies about which the algorithms differ. A structure's boxes have a colour for each level. " +
        "Arrow keys turn the view; + and − zoom.",
    ),
    several
      ? checkbox("list pairs within the resolution instead", false, (on) => {
          only_within = on;
          tell();
        }).element
      : null,
    pairs,
  );
  return { element, dispose: () => stage.dispose() };
}

// A press that does not move is a choice; one that moves turns the view.
function pick_by_mouse(stage: Stage, picked: (event: PointerEvent) => void): void {
  let pressed = { x: 0, y: 0 };
  stage.canvas.addEventListener(
    "pointerdown",
    (event) => (pressed = { x: event.clientX, y: event.clientY }),
  );
  stage.canvas.addEventListener("pointerup", (event) => {
    if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) <= 4) picked(event);
  });
}

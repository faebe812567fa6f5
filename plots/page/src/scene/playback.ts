// This section plays a scene. Nothing is decoded before it is opened.
import type { Recording } from "../bundle";
import { button } from "../base/controls";
import { make, quiet } from "../base/dom";
import { counted } from "../base/numbers";
import { section } from "../base/section";
import { Slices } from "../base/slices";
import { player } from "./player";

// A browser gives out few canvases: a scene that is opened closes the one before it.
let open: { close: () => void } | null = null;

export function playback(recording: Recording): HTMLElement {
  const place = make("div");
  const closed = (): void => place.replaceChildren(button("Open the scene", opening));

  function opening(): void {
    open?.close();
    const progress = make("span", { class: "quiet", role: "status" });
    const bar = button("Close the scene", () => mine.close());
    place.replaceChildren(bar, " ", progress);
    const given_up = new AbortController();
    let dispose = (): void => {};
    const mine = {
      close: () => {
        if (open === mine) open = null;
        given_up.abort();
        dispose();
        closed();
      },
    };
    open = mine;
    const slices = new Slices((text) => (progress.textContent = `Opening: ${text}`), given_up.signal);
    player(recording, slices).then(
      (opened) => {
        dispose = opened.dispose;
        place.replaceChildren(bar, opened.element);
      },
      (error: unknown) => {
        if (given_up.signal.aborted) return;
        bar.after(make("p", { class: "wrong" }, `The scene could not be drawn: ${String(error)}`));
      },
    );
  }

  closed();
  const bodies = recording.boxes_only
    ? counted(recording.bodies, "box", "boxes")
    : counted(recording.bodies, "body", "bodies");
  const { frames, frames_of_scene } = recording;
  const all =
    frames < frames_of_scene
      ? `the first ${frames} of ${frames_of_scene} frames`
      : counted(frames, "frame");
  return section(
    `${recording.name}: playback`,
    quiet(`${bodies}, ${all}, from ${recording.source}.`),
    place,
  );
}

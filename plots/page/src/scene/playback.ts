// This section plays a scene. Nothing is decoded before it is opened.
import type { Recording } from "../bundle";
import { button } from "../base/controls";
import { make, quiet } from "../base/dom";
import { count_text } from "../base/numbers";
import { section } from "../base/section";
import { player } from "./player";

// A browser gives out few canvases: a scene that is opened closes the one before it.
let open: { close: () => void } | null = null;

export function playback(recording: Recording): HTMLElement {
  const place = make("div");
  const closed = (): void => {
    place.replaceChildren(
      button("Open the scene", () => {
        open?.close();
        const { element, dispose } = player(recording);
        place.replaceChildren(button("Close the scene", () => open?.close()), element);
        open = {
          close: () => {
            open = null;
            dispose();
            closed();
          },
        };
      }),
    );
  };
  closed();
  const bodies = `${count_text(recording.bodies)} ${recording.boxes_only ? "boxes without bodies" : "bodies"}`;
  const { frames, frames_of_scene } = recording;
  const all = frames < frames_of_scene ? `the first ${frames} of ${frames_of_scene}` : `${frames}`;
  return section(
    `${recording.name}: playback`,
    quiet(
      `${bodies}, ${all} frames, from ${recording.source}, hash ${recording.hash}. ` +
        "Red and plain: certainly apart. Green and striped: its box overlaps another. " +
        "Blue and dotted: it overlaps another body, or touches it.",
    ),
    place,
  );
}

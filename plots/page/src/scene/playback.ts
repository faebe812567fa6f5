// The part of the page that plays a scene. Nothing is decoded before it is opened.
import type { Recording } from "../bundle";
import { button } from "../base/controls";
import { make, quiet } from "../base/dom";
import { count_text } from "../base/numbers";
import { section } from "../base/section";
import { player } from "./player";

export function playback(recording: Recording): HTMLElement {
  const place = make("div");
  place.append(button("Open the scene", () => place.replaceChildren(player(recording))));
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

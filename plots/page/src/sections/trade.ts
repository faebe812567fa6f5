// This section shows which configurations no other beats in both time and error.
import { checkbox, command_line, controls } from "../base/controls";
import { make, quiet } from "../base/dom";
import { part, section } from "../base/section";
import { front_chart, points_of, type Point } from "../charts/front";
import { on_click } from "../charts/style";
import type { Folder } from "../tables/folder";
import { grid } from "../tables/grid";
import { Table, type Row } from "../tables/table";

// A reader who picks a configuration sees what it is, what it costs, and where it errs.
function configuration(folder: Folder, row: Row): HTMLElement {
  const point = row.text("point");
  const columns = folder.table("points.csv").columns.filter((column) => row.text(column) !== "");
  const bins = folder.table("bins.csv");
  const of_point = bins.rows.filter((each) => each.text("point") === point);
  return make(
    "div",
    {},
    make("h4", {}, point),
    grid(
      Table.of(
        ["what", "value"],
        columns.map((column) => [column, row.text(column)]),
      ),
    ),
    of_point.length > 0
      ? quiet("Errors by the true gap, as parts of the smaller body's size:")
      : null,
    of_point.length > 0
      ? grid(
          Table.of(
            bins.columns,
            of_point.map((each) => bins.columns.map((column) => each.text(column))),
          ),
        )
      : null,
  );
}

export function trade(folder: Folder): HTMLElement | null {
  if (!folder.has("points.csv")) return null;
  const points = points_of(folder.rows("points.csv"));
  const figure = make("figure", { class: "scroll" });
  const details = make("div", { id: `${folder.anchor}-configuration`, "aria-live": "polite" });
  const pick = (row: Row): void => {
    details.replaceChildren(configuration(folder, row));
    details.scrollIntoView({ block: "nearest" });
  };
  const draw = (front_alone: boolean): void => {
    const chart = front_chart(front_alone ? points.filter((each) => each.front) : points);
    on_click<Point>(chart, (point) => pick(point.row));
    figure.replaceChildren(chart);
  };
  draw(false);
  const command = folder.fact("command_line");
  const measure = folder.fact("error");
  return section(
    `${folder.name}: trade`,
    part(
      `${folder.anchor}-chart`,
      "Time against error",
      quiet(
        `Error: ${measure || "the measure that was asked for"}. Filled diamonds on the line: no other configuration is both ` +
          "faster and more accurate. Points on the dashed line have no error. " +
          "Click a point, or press Enter on a row, to see its configuration.",
      ),
      controls(checkbox("the front alone", false, draw).element),
      figure,
      details,
      command ? quiet("This command repeats it:") : null,
      command ? command_line(command) : null,
      folder.has("front.csv") ? folder.grid("front.csv") : null,
    ),
    part(
      `${folder.anchor}-points-part`,
      "All configurations",
      folder.grid("points.csv", {
        lead: ["point", "front", "error", "seconds", "seconds_low", "seconds_high"],
        picked: pick,
      }),
    ),
  );
}

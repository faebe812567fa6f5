"""Time a query by the distance or depth of the pairs: the fastest right one of ours against that of each library, with
95 % intervals, and under it how far its worst answer is off; a column a kind of pairs, a line a task."""

import re
import sys

from matplotlib.lines import Line2D

import best
import common

TASKS = ["intersect", "distance", "penetration", "signed"]
RIGHT = 1e-3  # of the pair's size: as narrow_best.csv has it
NO_ERROR = 1e-17  # where an exact answer is drawn
KEY = ("scene_hash", "bodies", "boxes", "threads", "task", "pair_kind", "algorithm")
PLACED = re.compile(r"(?P<shapes>.+) (?P<side>gap|depth) (?P<size>[-+.e0-9]+)$")


def placed(row):
    """What the scene's name says: the shapes, and the signed distance; nothing for other scenes."""
    found = PLACED.match(row["scene"])
    if found is None or not row["task"] or row["threads"] != 1:
        return None
    size = float(found["size"])
    shapes = found["shapes"].replace("_", " ")
    # A scene of one kind of shapes is known by its name, of several by the kinds of the pair.
    kinds = row["pair_kind"]
    return (kinds if shapes == "primitives" else shapes), size if found["side"] == "gap" else -size


def panels_of(tables):
    """The rows of each task and kind of pairs, without who is wrong or far off."""
    errors = {tuple(row[c] for c in KEY): row for row in tables["agreement"]}
    panels = {}
    for row in tables["times"]:
        place = placed(row)
        graded = errors.get(tuple(row[c] for c in KEY))
        if place is None or graded is None or graded["wrong"] or (graded["worst_error"] or 0) > RIGHT:
            continue
        shapes, distance = place
        panels.setdefault((row["task"], shapes), []).append(
            {**row, "distance": distance, "error": graded["worst_error"]})
    # A scene at one distance is there for another question.
    return {key: rows for key, rows in panels.items() if len({row["distance"] for row in rows}) > 1}


def draw_times(axes, points, style):
    y = [row["seconds"] * 1e9 for _, row in points]
    low, high = ([abs((row["seconds"] if row[end] is None else row[end]) - row["seconds"]) * 1e9
                  for _, row in points] for end in ("seconds_low", "seconds_high"))
    axes.errorbar([x for x, _ in points], y, yerr=[low, high], capsize=1.2, elinewidth=0.6, capthick=0.6, **style)


def draw_errors(axes, points, style):
    axes.plot([x for x, _ in points], [max(row["error"] or 0, NO_ERROR) for _, row in points], **style)


def draw(tables):
    panels = panels_of(tables)
    if not panels:
        return None
    # A verdict that is drawn is right: it has no line of errors.
    lines = []
    for task in TASKS:
        if any(t == task for t, _ in panels):
            lines.append((task, f"{task}: ns a query", draw_times))
            if task != "intersect":
                lines.append((task, "worst error", draw_errors))
    columns = common.in_order(shapes for _, shapes in panels)
    bests = {key: best.of(rows, "distance") for key, rows in panels.items()}
    styles = best.styles_of({name for found in bests.values() for name, _ in found})
    figure, grid = common.pyplot.subplots(
        len(lines), len(columns), squeeze=False, sharey="row", constrained_layout=True,
        figsize=(common.PAGE_WIDTH * 1.6, 0.4 + 1.35 * len(lines)))
    for line, (task, label, draw_points) in enumerate(lines):
        for column, shapes in enumerate(columns):
            axes = grid[line][column]
            found = bests.get((task, shapes))
            if found is None:
                axes.set_visible(False)
                continue
            # Regimes stand side by side, from far apart to deep.
            distances = sorted({distance for _, distance in found}, reverse=True)
            for name, style in styles.items():
                points = sorted((distances.index(distance), row)
                                for (own, distance), row in found.items() if own == name)
                if points:
                    draw_points(axes, points, style)
            axes.set_yscale("log")
            axes.grid(True)
            axes.set_xticks(range(len(distances)), [f"{distance:g}" for distance in distances], rotation=60)
            if line == 0:
                axes.set_title(shapes, loc="left", fontsize=6.5)
            if column == 0:
                axes.set_ylabel(label)
            if line + 1 == len(lines):
                axes.set_xlabel("distance (m)")
    common.legend_below(figure, [Line2D([], [], label=name, **style)
                                 for name, style in styles.items()], columns=9)
    return figure


draw.needs = "pairs at stated distances, as in datasets/campaigns/narrow.toml"


if __name__ == "__main__":
    sys.exit(common.run({"narrow": draw}, __doc__))

"""Time a frame against error: every configuration of a trade on one scene, and the Pareto front, each of its points
by name; what is dominated is grey.

    python3 plots/trade.py RESULTS [--out DIR]      RESULTS as `touchstone advise --front` leaves it
"""

import csv
import math
import os
import sys

from matplotlib.lines import Line2D

import common

GREY = "#b0b0b0"
NUMBERS = ("error", "seconds", "seconds_low", "seconds_high", "front", "baseline")
PARTS = ("representation", "boxes", "substeps", "broad", "narrow", "scalar", "tolerance", "max_iterations")


def read(folder):
    """The points that have a time and an error, and the facts of the run."""
    try:
        with common.open_rows(os.path.join(folder, "points.csv")) as file:
            rows = list(csv.DictReader(file))
        with open(os.path.join(folder, "machine.csv"), newline="", encoding="utf-8") as file:
            facts = {row["name"]: row["value"] for row in csv.DictReader(file)}
        for row in rows:
            for column in NUMBERS:
                row[column] = float(row[column]) if row[column] else None
    except FileNotFoundError as error:
        raise common.BadRequest(f"{error.filename} is missing; `touchstone advise SCENE --front` writes it") from None
    except (KeyError, ValueError) as error:
        raise common.BadRequest(f"{folder}: {error} in points.csv or machine.csv") from None
    return [r for r in rows if r["status"] == "ok" and r["seconds"] and r["error"] is not None], facts


def short(row, common_parts):
    """The name without what all points of the front share."""
    words = []
    for part in PARTS:
        value = row.get(part)
        if not value or part in common_parts or (part == "substeps" and value == "0"):
            continue
        if part == "tolerance":
            value = "tol " + value
        elif part == "max_iterations":
            value = "cap " + value
        elif part == "narrow" and value == "none":
            value = "boxes alone"
        elif part == "boxes":
            value += " boxes"
        elif part == "substeps":
            value += " substep" if value == "1" else " substeps"
        words.append(value.replace("_", " "))
    return ", ".join(words) or row["narrow"]


def family(row):
    """What its colour stands for: the form that stands for bodies, without its fineness; of motion, the way."""
    if "method" in row:
        return row["method"]
    representation = row["representation"]
    if "=" in representation:
        return "by kind"
    form, _, side = representation.partition(" ")
    kind, _, fineness = form.rpartition("-")
    name = kind if fineness.isdigit() else form
    name = {"dop": "k-DOP", "hull": "reduced hull" if fineness.isdigit() else "hull"}.get(name, name.replace("-", " "))
    return f"{name} {side}".strip()


def spread(centres, least):
    """Heights as near to these, which ascend, as they can be with so much between each two."""
    blocks = []  # [sum of wanted heights of the first, members]
    for i, centre in enumerate(centres):
        blocks.append([centre - least * i, 1])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1][0] += total
            blocks[-1][1] += count
    placed = []
    for total, count in blocks:
        placed += [total / count] * count
    return [height + least * i for i, height in enumerate(placed)]


def draw(rows, facts):
    front = sorted((r for r in rows if r["front"]), key=lambda r: r["seconds"])
    others = [r for r in rows if not r["front"]]
    errors = [r["error"] for r in rows if r["error"] > 0]
    floor = 10 ** math.floor(math.log10(min(errors))) if errors else 1e-3
    top = max(errors, default=1)
    lines = len(front)
    figure, axes = common.pyplot.subplots(figsize=(common.PAGE_WIDTH, max(3.6, 1.2 + 0.17 * lines)))
    figure.subplots_adjust(left=0.09, right=0.56, bottom=0.14, top=0.9)
    axes.set_xscale("log")
    # Below the least error there is room for those that make none.
    axes.set_yscale("symlog", linthresh=floor, linscale=0.6)
    # By hand: left alone, a tick of a tenth of the floor is drawn on that of zero.
    axes.set_yticks([0] + [floor * 10**k for k in range(round(math.log10(max(1, top) / floor)) + 1)])
    milliseconds = [r["seconds"] * 1e3 for r in rows]
    axes.set_xlim(min(milliseconds) / 1.25, max(milliseconds) * 1.25)
    axes.set_ylim(-0.25 * floor, top * 1.6)
    axes.grid(True)
    axes.plot([r["seconds"] * 1e3 for r in others], [r["error"] for r in others], "o", color=GREY,
              markersize=2.4, markeredgewidth=0, zorder=2)
    steps_x, steps_y = [], []
    for i, row in enumerate(front):
        if i:
            steps_x.append(row["seconds"] * 1e3)
            steps_y.append(front[i - 1]["error"])
        steps_x.append(row["seconds"] * 1e3)
        steps_y.append(row["error"])
    axes.plot(steps_x, steps_y, color="#333333", linewidth=0.8, zorder=3)
    families = common.in_order(family(r) for r in front)
    styles = {name: (common.COLOURS[i % len(common.COLOURS)],
                     common.MARKERS[(i + i // len(common.COLOURS)) % len(common.MARKERS)])
              for i, name in enumerate(families)}
    for row in front:
        colour, marker = styles[family(row)]
        if row["seconds_low"] and row["seconds_high"]:
            axes.plot([row["seconds_low"] * 1e3, row["seconds_high"] * 1e3], [row["error"]] * 2,
                      color=colour, linewidth=1, zorder=4)
        axes.plot(row["seconds"] * 1e3, row["error"], marker, color=colour, zorder=5,
                  markersize=4.4)
    name_points(figure, axes, front, styles)
    axes.set_xlabel("milliseconds a " + ("step" if "method" in rows[0] else "frame"))
    axes.set_ylabel("error: " + {"verdicts": "share of wrong verdicts",
                                 "false-negatives": "share of contacts missed",
                                 "mean": "mean, part of the size",
                                 "p99": "99th percentile, part of the size",
                                 "greatest": "greatest, part of the size",
                                 "volume": "greatest in volume",
                                 "missed-hits": "share of hits missed in a step",
                                 "hausdorff": "greatest Hausdorff distance, part of the size",
                                 }.get(facts.get("error", ""), "part"))
    threads = facts.get("threads", "1")
    axes.set_title(f"{facts.get('campaign', '')}: {facts.get('bodies', '?')} bodies, "
                   f"{facts.get('task', '')}, {threads} thread{'' if threads == '1' else 's'}; "
                   f"{len(rows)} configurations, {len(front)} on the front", loc="left")
    handles = [Line2D([], [], linestyle="", marker=styles[n][1], color=styles[n][0], label=n) for n in families]
    handles.append(Line2D([], [], linestyle="", marker="o", markersize=2.4, color=GREY, label="dominated"))
    common.legend_below(figure, handles, columns=6)
    return figure


def name_points(figure, axes, front, styles):
    """Names in a column to the right, in the order of the points' heights, each with a thin line to its point."""
    same = {part for part in PARTS if len({r.get(part) for r in front}) == 1} if len(front) > 1 else set()
    figure.canvas.draw()
    to_axes = axes.transAxes.inverted()
    # The highest error is the quickest: from top to bottom along the front.
    named = sorted(front, key=lambda r: (r["error"], -r["seconds"]))
    places = [to_axes.transform(axes.transData.transform((r["seconds"] * 1e3, r["error"]))) for r in named]
    least = min(0.052 * 3.6 / figure.get_size_inches()[1], 1.0 / max(len(named) - 1, 1))
    heights = spread([place[1] for place in places], least)
    shift = max(0, heights[-1] - 1) if heights else 0
    heights = [h - shift for h in heights]
    if heights and heights[0] < 0:
        heights = [i * least for i in range(len(heights))]
    for row, place, height in zip(named, places, heights):
        colour = styles[family(row)][0]
        axes.annotate(short(row, same) + f" ({row['seconds'] * 1e3:.3g} ms)", xy=place, xytext=(1.03, height),
                      xycoords="axes fraction", textcoords="axes fraction", va="center", ha="left", fontsize=6,
                      color=colour, annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.35, "alpha": 0.6,
                                  "shrinkA": 1, "shrinkB": 3})
    if same:
        axes.annotate("all of the front: " + short(front[0], set(PARTS) - same), xy=(1.03, -0.11), fontsize=6,
                      xycoords="axes fraction", va="center", ha="left", color="#555555", annotation_clip=False)


def run(folder, out):
    rows, facts = read(folder)
    if not rows:
        raise common.BadRequest(f"{folder}: no configuration has a time; nothing was drawn")
    os.makedirs(out, exist_ok=True)
    print(", ".join(common.save(draw(rows, facts), out, "trade")))


if __name__ == "__main__":
    sys.exit(common.run_on(run, __doc__))

"""Maps of a stress sweep: for each algorithm and scalar what became of its answers, axis by axis."""

import csv
import os
import sys

from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

import common

# From the outcome that one hopes for to the one that one fears; drawn from below in this order.
OUTCOMES = {
    "right": ("#cfe8dd", "right"),
    "honest": ("#E69F00", "gave up"),
    "rounded": ("#f2b9d6", "wrong, as the input was rounded"),
    "silent": ("#C1121F", "silently wrong"),
    "crashed": ("#000000", "crashes"),
    "hung": ("#5B2A86", "hangs"),
}
LEAST = 0.16  # of a field, that an outcome which was seen once is drawn with
COLUMNS = 4
NOT_ASKED = "#eeeeee"  # no such pairs


def read(folder):
    """{(algorithm, scalar): {axis: {value: counts}}}, the axes' values in order, and who is ours."""
    maps, values, ours = {}, {}, set()
    path = os.path.join(folder, "stress.csv")
    try:
        with common.open_rows(path) as file:
            for row in csv.DictReader(file):
                axis = maps.setdefault((row["algorithm"], row["scalar"]), {}).setdefault(row["axis"], {})
                counts = axis.setdefault(row["value"], dict.fromkeys(OUTCOMES, 0))
                for outcome in OUTCOMES:
                    counts[outcome] += int(row[outcome])
                known = values.setdefault(row["axis"], [])
                if row["value"] not in known:
                    known.append(row["value"])
        with common.open_rows(os.path.join(folder, "envelope.csv")) as file:
            ours = {row["algorithm"] for row in csv.DictReader(file) if row["origin"] == "ours"}
    except FileNotFoundError as error:
        raise common.BadRequest(f"{error.filename} is missing; `touchstone check --axes` writes it") from None
    except (ValueError, TypeError, KeyError) as error:
        raise common.BadRequest(f"{path}: {error}") from None
    return maps, values, ours


def heights(counts):
    """How much of a field each outcome fills; what was seen at all is seen on the map."""
    total = sum(counts.values())
    shares = {outcome: count / total for outcome, count in counts.items() if count}
    rare = {outcome for outcome, share in shares.items() if share < LEAST}
    rest = sum(share for outcome, share in shares.items() if outcome not in rare)
    return {outcome: LEAST if outcome in rare else share * (1 - LEAST * len(rare)) / rest
            for outcome, share in shares.items()}


def add_boxes(axes, boxes, **style):
    """Boxes (left, top, right, bottom) as one path, which keeps the file small."""
    corners, codes = [], []
    for x0, y0, x1, y1 in boxes:
        corners += [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]
        codes += [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    if corners:
        axes.add_patch(PathPatch(Path(corners, codes), **style))


def draw_map(axes, title, by_axis, values, left):
    names = list(values)
    longest = max(len(v) for v in values.values())
    boxes = {}  # of a colour
    for y, name in enumerate(names):
        for x, value in enumerate(values[name]):
            counts = by_axis.get(name, {}).get(value)
            if not counts or not sum(counts.values()):
                parts = [(NOT_ASKED, y, y + 1)]
            else:
                parts, bottom = [], y + 1
                for outcome, height in heights(counts).items():
                    parts.append((OUTCOMES[outcome][0], bottom - height, bottom))
                    bottom -= height
            for colour, top, bottom in parts:
                row = boxes.setdefault(colour, [])
                last = next((i for i, box in enumerate(row) if box[1:] == (top, x, bottom)), None)
                if last is None:
                    row.append((x, top, x + 1, bottom))
                else:  # one box with that at its left
                    row[last] = (row[last][0], top, x + 1, bottom)
    for colour, row in boxes.items():
        add_boxes(axes, row, facecolor=colour, linewidth=0)
    lines = [(x, 0, x, len(names)) for x in range(1, longest)]
    lines += [(0, y, longest, y) for y in range(1, len(names))]
    axes.add_patch(PathPatch(
        Path([end for x0, y0, x1, y1 in lines for end in ((x0, y0), (x1, y1))],
             [Path.MOVETO, Path.LINETO] * len(lines)),
        fill=False, edgecolor="white", linewidth=0.3))
    axes.set_xlim(0, longest)
    axes.set_ylim(len(names), 0)
    axes.set_title(title, fontsize=6.4, pad=2)
    axes.set_xticks([])
    axes.set_yticks([])
    if left:
        axes.set_yticks([y + 0.5 for y in range(len(names))],
                        [f"{name}  {values[name][0]} … {values[name][-1]}" for name in names], fontsize=5)
    axes.tick_params(length=0, pad=1)
    for side in axes.spines.values():
        side.set_visible(False)


def figure_of(sweep, of_ours):
    maps, values, ours = sweep
    subjects = [s for s in maps if (s[0] in ours) == of_ours]
    if not subjects:
        return None
    figure, panels = common.grid(len(subjects), 0.28 + 0.095 * len(values), columns=COLUMNS)
    for i, (subject, axes) in enumerate(zip(subjects, panels)):
        draw_map(axes, f"{subject[0]}, {subject[1]}", maps[subject], values, i % COLUMNS == 0)
    handles = [Patch(facecolor=colour, label=label) for colour, label in OUTCOMES.values()]
    handles.append(Patch(facecolor=NOT_ASKED, label="no such pairs"))
    common.legend_below(figure, handles, columns=4)
    return figure


FIGURES = {
    "stress_ours": lambda sweep: figure_of(sweep, True),
    "stress_peers": lambda sweep: figure_of(sweep, False),
}


def run(folder, out):
    sweep = read(folder)
    os.makedirs(out, exist_ok=True)
    if common.save_all(FIGURES, sweep, out) == 0:
        raise common.BadRequest(f"{folder}: no answers; nothing was drawn")


if __name__ == "__main__":
    sys.exit(common.run_on(run, __doc__))

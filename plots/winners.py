"""The fastest algorithm that answers right, by scene and count, and its lead over the runner-up."""

import sys

from matplotlib.patches import Patch, Rectangle

import common

COLUMNS = ["bodies", "boxes", "threads", "rebuild", "isa_limit", "seed"]


def pale(colour, part):
    """The colour mixed with so much white."""
    values = [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(v + (255 - v) * part):02x}" for v in values)


def draw(tables):
    rows = [r for r in tables["winners"] if not r["task"] and r["ratio"] is not None]
    if not rows:
        return None
    scenes = common.in_order(r["scene"] for r in rows)
    settings = sorted({tuple(r[c] for c in COLUMNS) for r in rows},
                      key=lambda s: (*s[1:], s[0]))
    titles = ["bodies"] + common.varying(rows, COLUMNS[1:])
    styles = tables.styles()
    figure, (axes,) = common.grid(1, 0.75 + 0.42 * len(scenes))
    for row in rows:
        x = settings.index(tuple(row[c] for c in COLUMNS))
        y = scenes.index(row["scene"])
        decided = row["ratio_low"] is not None and row["ratio_low"] > 1
        style = styles[row["winner"]]
        axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=pale(style["color"], 0.62),
                                 edgecolor="white", linewidth=1.2))
        if not decided:
            axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, fill=False, hatch="////",
                                     edgecolor="white", linewidth=0))
        axes.text(x, y - 0.2, row["winner"], ha="center", va="center", fontsize=6.4)
        lead = f"{row['ratio']:.2f} × as fast as" if decided else "not told apart from"
        axes.text(x, y + 0.2, f"{lead}\n{row['runner_up']}", ha="center", va="center",
                  fontsize=5.2, linespacing=1.2, color="#333333")
    axes.set_xlim(-0.5, len(settings) - 0.5)
    axes.set_ylim(len(scenes) - 0.5, -0.5)
    axes.set_xticks(range(len(settings)),
                    ["\n".join(common.words(dict(zip(COLUMNS, s)), [c]) for c in titles)
                     for s in settings])
    axes.set_yticks(range(len(scenes)), [s.replace("_", " ") for s in scenes])
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)
    used = common.in_order(r["winner"] for r in rows)
    handles = [Patch(facecolor=pale(styles[n]["color"], 0.62), label=n) for n in styles if n in used]
    if any(r["ratio_low"] is None or r["ratio_low"] <= 1 for r in rows):
        handles.append(Patch(facecolor="#cccccc", hatch="////", edgecolor="white",
                             label="the interval of the lead holds 1"))
    common.legend_below(figure, handles)
    return figure


draw.needs = "broad phases with an interval of the ratio"


if __name__ == "__main__":
    sys.exit(common.run({"winners": draw}, __doc__))

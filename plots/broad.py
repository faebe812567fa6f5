"""Time a body against the number of bodies: the best of ours against the best of each library, log-log, with 95 %
intervals; a column a scene, the upper line rebuilt each frame and the lower one updated. The limit is in the upper one
alone: one that keeps what it found before need not sort."""

import sys

from matplotlib.lines import Line2D

import best
import common

LINES = [(1, "rebuilt"), (0, "updated")]


def draw(tables):
    rows = [r for r in tables["times"]
            if not r["task"] and not r["isa_limit"] and r["threads"] == 1]
    panels = {}
    for row in rows:
        panels.setdefault((row["scene"], row["rebuild"]), []).append(row)
    # Only where ours meet others at several counts.
    panels = {key: own for key, own in panels.items()
              if len({r["bodies"] for r in own if r["origin"] == "ours"}) > 1
              and any(r["origin"] == "peer" for r in own)}
    if not panels:
        return None
    scenes = common.in_order(scene for scene, _ in panels)
    lines = [(value, word) for value, word in LINES if any(r == value for _, r in panels)]
    bests = {key: best.of(own, "bodies") for key, own in panels.items()}
    styles = best.styles_of({name for found in bests.values() for name, _ in found})
    figure, grid = common.pyplot.subplots(
        len(lines), len(scenes), squeeze=False, sharex=True, sharey=True, constrained_layout=True,
        figsize=(common.PAGE_WIDTH, 0.4 + 1.45 * len(lines)))
    for line, (value, word) in enumerate(lines):
        for column, scene in enumerate(scenes):
            axes = grid[line][column]
            found = bests.get((scene, value))
            if found is None:
                axes.set_visible(False)
                continue
            for name, style in styles.items():
                points = sorted((r for (own, _), r in found.items() if own == name),
                                key=lambda r: r["bodies"])
                if not points or (name == best.LIMIT and not value):
                    continue
                y = [r["seconds"] / r["bodies"] * 1e9 for r in points]
                low, high = ([abs((r["seconds"] if r[end] is None else r[end]) - r["seconds"])
                              / r["bodies"] * 1e9 for r in points]
                             for end in ("seconds_low", "seconds_high"))
                axes.errorbar([r["bodies"] for r in points], y, yerr=[low, high], capsize=1.2,
                              elinewidth=0.6, capthick=0.6, **style)
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.grid(True)
            if line == 0:
                axes.set_title(scene.replace("_", " "), loc="left")
            if line + 1 == len(lines):
                axes.set_xlabel("boxes")
            if column == 0:
                axes.set_ylabel(f"{word}: ns a box")
    common.legend_below(figure, [Line2D([], [], label=name, **style)
                                 for name, style in styles.items()], columns=9)
    return figure


draw.needs = "broad phases of ours and of libraries at several numbers of bodies, at one thread, as in datasets/campaigns/broad.toml"


if __name__ == "__main__":
    sys.exit(common.run({"broad": draw}, __doc__))

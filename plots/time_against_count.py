"""Time of a frame against the number of bodies, log-log, with 95 % intervals and fitted exponents."""

import math
import sys

from matplotlib.lines import Line2D

import common

KEY = ["scene", "boxes", "threads", "rebuild", "isa_limit", "seed"]


def spread(positions, gap):
    """Moves sorted positions apart to at least `gap`, each as little as that allows."""
    clusters = []
    for position in positions:
        clusters.append([position, 1])  # centre, size
        while len(clusters) > 1:
            (below, n), (above, m) = clusters[-2], clusters[-1]
            if above - below >= gap * (n + m) / 2:
                break
            clusters[-2:] = [[(below * n + above * m) / (n + m), n + m]]
    moved = []
    for centre, size in clusters:
        moved += [centre + gap * (i - (size - 1) / 2) for i in range(size)]
    return moved


def label_exponents(axes, ends):
    """Writes each exponent beside the right end of its line, in the line's colour."""
    low, high = (math.log(limit) for limit in axes.get_ylim())
    ends = sorted(ends, key=lambda end: end[1])
    places = [(math.log(y) - low) / (high - low) for _, y, _, _ in ends]
    for (x, y, text, colour), place in zip(ends, spread(places, 0.062)):
        axes.annotate(text, xy=(x, y), xycoords="data", xytext=(1.03, place),
                      textcoords="axes fraction", color=colour, fontsize=6.5, va="center",
                      arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.3,
                                  "shrinkA": 0, "shrinkB": 3})


def draw(tables):
    rows = [r for r in tables["times"] if not r["task"] and r["seconds"] is not None]
    exponents = {(*(r[c] for c in KEY[:5]), r["algorithm"]): r for r in tables["exponents"]}
    inputs = {}
    for row in rows:
        inputs.setdefault(tuple(row[c] for c in KEY), []).append(row)
    inputs = {key: own for key, own in inputs.items() if len({r["bodies"] for r in own}) > 1}
    if not inputs:
        return None
    shown = [own[0] for own in inputs.values()]
    titles = ["scene"] + common.varying(shown, KEY[1:])
    styles = tables.styles()
    figure, panels = common.grid(len(inputs), 2.1)
    used = set()
    for axes, (key, own) in zip(panels, inputs.items()):
        ends = []
        for name in common.in_order(r["algorithm"] for r in own):
            points = sorted((r for r in own if r["algorithm"] == name), key=lambda r: r["bodies"])
            x = [r["bodies"] for r in points]
            y = [r["seconds"] * 1e3 for r in points]
            down = [0 if r["seconds_low"] is None else (r["seconds"] - r["seconds_low"]) * 1e3
                    for r in points]
            up = [0 if r["seconds_high"] is None else (r["seconds_high"] - r["seconds"]) * 1e3
                  for r in points]
            axes.errorbar(x, y, yerr=[down, up], capsize=1.5, elinewidth=0.7, capthick=0.7,
                          **styles[name])
            used.add(name)
            law = exponents.get((*key[:5], name))
            if law is not None and len(points) > 1:
                text = f"{law['exponent']:.2f}"
                if law["exponent_low"] is not None:
                    text += f" ± {law['exponent_high'] - law['exponent']:.2f}"
                ends.append((x[-1], y[-1], text, styles[name]["color"]))
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.grid(True)
        axes.set_title(common.words(own[0], titles), loc="left")
        label_exponents(axes, ends)
    for axes in panels:
        axes.set_xlabel("bodies")
        axes.set_ylabel("time of a frame (ms)")
    names = [name for name in styles if name in used]
    common.legend_below(figure, [Line2D([], [], label=name, **styles[name]) for name in names])
    return figure


draw.needs = "a scene with several numbers of bodies"


if __name__ == "__main__":
    sys.exit(common.run({"time_against_count": draw}, __doc__))

"""How often each narrow phase answers wrong, fails, or gives no answer, against exact answers."""

import sys

from matplotlib.lines import Line2D

import common

KINDS = {
    "wrong": {"color": "#D55E00", "marker": "X", "label": "wrong, and said to be right"},
    "failed": {"color": "#0072B2", "marker": "o", "label": "gave up"},
    "unanswered": {"color": "#888888", "marker": "s", "label": "no answer, or not compared"},
}


def draw(tables):
    counts = {}
    for row in tables["agreement"]:
        own = counts.setdefault(row["task"], {}).setdefault(
            row["algorithm"], dict.fromkeys(["queries", "right", *KINDS], 0))
        for column in own:
            own[column] += row[column]
    if not counts:
        return None
    styles = tables.styles(narrow=True)
    names = [n for n in styles if any(n in task for task in counts.values())]
    # The gutter left of the least share that could have been seen stands for none at all.
    most = max(own["queries"] for task in counts.values() for own in task.values())
    least = 10.0 ** -len(str(int(most)))
    none = least / 2.5
    figure, panels = common.grid(len(counts), 0.75 + 0.155 * len(names), sharey=True)
    for axes, (task, by_name) in zip(panels, counts.items()):
        for place, name in enumerate(names):
            own = by_name.get(name)
            if own is None:
                axes.text(0.5, place, "not offered", transform=axes.get_yaxis_transform(),
                          ha="center", va="center", fontsize=6, color="#888888")
                continue
            for i, (kind, style) in enumerate(KINDS.items()):
                share = own[kind] / own["queries"]
                axes.plot([share if share > 0 else none * 1.22 ** (i - 1)], [place + 0.2 * (i - 1)], linestyle="",
                          marker=style["marker"], color=style["color"], markersize=3.4,
                          markerfacecolor=style["color"] if share > 0 else "white",
                          markeredgewidth=0.6, clip_on=False)
            axes.text(1.02, place, f"{100 * own['right'] / own['queries']:.4g} %",
                      transform=axes.get_yaxis_transform(), va="center", fontsize=6.2)
        axes.set_xscale("log")
        axes.set_xlim(none / 1.8, 1.3)
        decades = [10.0**e for e in range(-len(str(int(most))), 1)]
        axes.set_xticks([none, *decades],
                        ["0", *(f"$10^{{{e}}}$" for e in range(-len(str(int(most))), 1))])
        axes.minorticks_off()
        axes.axvline(least / 1.5, color="#bbbbbb", linewidth=0.5)
        axes.set_yticks(range(len(names)), names)
        axes.set_ylim(len(names) - 0.4, -0.6)
        axes.tick_params(axis="y", length=0)
        axes.grid(True, axis="x")
        axes.set_title(task, loc="left")
        axes.text(1.02, 1.02, "right side", transform=axes.transAxes, fontsize=6.2)
        axes.set_xlabel("share of the queries")
    handles = [Line2D([], [], linestyle="", **style) for style in KINDS.values()]
    common.legend_below(figure, handles)
    return figure


draw.needs = "narrow phases"


if __name__ == "__main__":
    sys.exit(common.run({"agreement": draw}, __doc__))

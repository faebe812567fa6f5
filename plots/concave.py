"""Time a query of each concave phase on scenes whose bodies are not convex, with 95 % intervals, a panel a scene, kind of
pairs and task; beside who answered wrong stands how often."""

import sys

from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

import common

KINDS = {"mesh", "solid", "compound"}  # of the bodies in a pair's kind
KEY = ("scene", "bodies", "boxes", "threads", "pair_kind", "task")
GRADED = KEY + ("seed", "algorithm")


def draw(tables):
    times = [row for row in tables["times"] if row["task"] and KINDS & set(row["pair_kind"].split("-"))]
    if not times:
        return None
    wrong = {tuple(row[c] for c in GRADED): row["wrong"] or 0 for row in tables["agreement"]}
    panels = {}
    for row in times:
        if row["seconds"] is not None and not row["pairs_of"]:
            panels.setdefault(tuple(row[c] for c in KEY), []).append(row)
    if not panels:
        return None
    styles = tables.styles(narrow=True)
    most = max(len(rows) for rows in panels.values())
    figure, grid = common.grid(len(panels), 0.6 + 0.14 * most)
    named = [c for c in ("scene", "bodies", "boxes", "threads")
             if c == "scene" or c in common.varying(times, KEY)]
    for axes, rows in zip(grid, panels.values()):
        rows.sort(key=lambda row: -row["seconds"])
        for place, row in enumerate(rows):
            low, high = (abs((row["seconds"] if row[end] is None else row[end]) - row["seconds"]) * 1e6
                         for end in ("seconds_low", "seconds_high"))
            count = wrong.get(tuple(row[c] for c in GRADED), 0)
            style = {**styles[row["algorithm"]], "linestyle": ""}
            axes.errorbar([row["seconds"] * 1e6], [place], xerr=[[low], [high]], capsize=1.5, elinewidth=0.7,
                          capthick=0.7, **style)
            if count:
                axes.annotate(f"{int(count)} wrong", (row["seconds"] * 1e6, place), xytext=(6, -2),
                              textcoords="offset points", fontsize=5, color="#D55E00")
        axes.set_yticks(range(len(rows)), [row["algorithm"] for row in rows], fontsize=5.5)
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.tick_params(axis="x", labelsize=5, labelrotation=45)
        axes.grid(True, axis="x")
        axes.set_title(f"{common.words(rows[0], named)}\n{rows[0]['pair_kind']}, {rows[0]['task']}",
                       loc="left", fontsize=6.5)
        axes.set_xlabel("us a query")
    return figure


draw.needs = "pairs with meshes or compounds"


if __name__ == "__main__":
    sys.exit(common.run({"concave": draw}, __doc__))

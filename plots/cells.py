"""Time a query of each algorithm on the cells of a campaign of kinds: rays, points, concave bodies, casts, features that
move and moving scenes. A panel a group; an answer that was wrong has a cross beside its mark."""

import os
import sys

from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

import common

FILE = "set_grades.csv"  # only a folder of cells has one
TEXTS = {"group", "cell", "algorithm", "origin", "truth", "hit_hash", "status"}
WRONG = ("missed", "false_hits", "inexact")
RED = "#B2182B"


def is_wrong(row):
    return any(row[column] for column in WRONG)


def draw(rows):
    rows = [row for row in rows if row["seconds"] is not None]
    if not rows:
        raise common.BadRequest("no cell has a time; nothing was drawn")
    styles = common.styles_of(rows)
    groups = common.in_order(row["group"] for row in rows)
    cells = {group: common.in_order(row["cell"] for row in rows if row["group"] == group) for group in groups}
    most = max(len(of_group) for of_group in cells.values())
    figure, grid = common.grid(len(groups), 0.65 + (0.36 if most <= 8 else 0.22) * most)
    # Each algorithm has a line of its own within a cell, so that no mark hides another.
    lines = {name: (k + 0.5) / len(styles) * 0.8 - 0.4 for k, name in enumerate(styles)}
    for axes, group in zip(grid, groups):
        for row in (row for row in rows if row["group"] == group):
            place, time = cells[group].index(row["cell"]) + lines[row["algorithm"]], row["seconds"] * 1e9
            axes.plot([time], [place], **{**styles[row["algorithm"]], "linestyle": "", "zorder": 3})
            if is_wrong(row):
                axes.plot([time], [place], marker="x", markersize=4.5, color=RED, linestyle="", zorder=4)
        axes.set_title(group.replace(", ", ",\n"))
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
        if axes.get_xlim()[1] < 1e5:
            axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.10g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.set_yticks(range(len(cells[group])), cells[group])
        axes.set_ylim(len(cells[group]) - 0.5, -0.5)
        axes.set_xlabel("ns a query")
        axes.grid(True, axis="x")
        for edge in range(1, len(cells[group])):
            axes.axhline(edge - 0.5, color="#dddddd", linewidth=0.4)
        axes.tick_params(axis="y", length=0)
    handles = [Line2D([], [], label=name, **{**style, "linestyle": ""}) for name, style in styles.items()]
    if any(is_wrong(row) for row in rows):
        handles.append(Line2D([], [], label="wrong at least once", marker="x", color=RED, linestyle=""))
    common.legend_below(figure, handles, columns=3 if max(map(len, styles)) > 24 else 4)
    return figure


def run(folder, out):
    figure = draw(common.read_table(folder, "set_times", TEXTS))
    os.makedirs(out, exist_ok=True)
    print(", ".join(common.save(figure, out, "cells")))


if __name__ == "__main__":
    sys.exit(common.run_on(run, __doc__))

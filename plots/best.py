"""The best of ours, and of each library, where a figure shows no more of them."""

import common

OURS, WARM, LIMIT = "ours", "ours, warm", "limit"


def family(row):
    """Whose it is: ours, those of ours that start warm, the limit's, or a library's, by the first word of the name."""
    if row["origin"] == "ours":
        return WARM if row["algorithm"].endswith(" warm") else OURS
    return row["algorithm"].split("-")[0]


def of(rows, x):
    """The fastest right answer of each family at each value of the column x."""
    best = {}
    for row in rows:
        if row["seconds"] is None or row["wrong"] or row["failure"]:
            continue
        place = (family(row), row[x])
        if place not in best or row["seconds"] < best[place]["seconds"]:
            best[place] = row
    return best


def styles_of(families):
    """Ours is thick and black, and red where it starts warm; the limit a thin grey line; libraries dashed, in the order
    of the alphabet."""
    styles = {}
    others = sorted(name for name in families if name not in (OURS, WARM, LIMIT))
    colours = [c for c in common.COLOURS if c != "#000000"]
    for i, name in enumerate(others):
        styles[name] = {"color": colours[i % len(colours)], "linestyle": "--",
                        "marker": common.MARKERS[1 + i % (len(common.MARKERS) - 1)],
                        "markerfacecolor": "white", "markeredgewidth": 0.8, "zorder": 2}
    styles[OURS] = {"color": "#000000", "linestyle": "-", "marker": "o", "linewidth": 1.6, "zorder": 3}
    styles[WARM] = {**styles[OURS], "color": "#AA0000", "marker": "s"}
    styles[LIMIT] = {"color": "#999999", "linestyle": ":", "zorder": 1}
    return {name: styles[name] for name in (OURS, WARM, *others, LIMIT) if name in families}

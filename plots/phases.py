"""Where the time of a broad phase goes: build, update, find pairs, as shares of a frame."""

import sys

from matplotlib.patches import Patch

import common

KEY = ["scene", "bodies", "boxes", "threads", "rebuild", "isa_limit", "seed"]
PARTS = {"build": "#E69F00", "update": "#56B4E9", "find_pairs": "#0072B2"}


def time_text(seconds):
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def draw(tables):
    rows = [r for r in tables["times"] if not r["task"] and r["seconds"] is not None]
    if not rows:
        return None
    inputs = {}
    for row in rows:
        inputs.setdefault(tuple(row[c] for c in KEY), []).append(row)
    # Of each scene the greatest count: the smaller ones are in the figure of time against count.
    greatest = {}
    for key, own in inputs.items():
        other = (key[0], *key[2:])
        if other not in greatest or greatest[other][0]["bodies"] < own[0]["bodies"]:
            greatest[other] = own
    shown = [own[0] for own in greatest.values()]
    titles = ["scene", "bodies"] + common.varying(shown, KEY[2:])
    names = common.in_order(r["algorithm"] for own in greatest.values() for r in own)
    figure, panels = common.grid(len(greatest), 0.55 + 0.17 * len(names), sharey=True)
    for axes, own in zip(panels, greatest.values()):
        by_name = {r["algorithm"]: r for r in own}
        for place, name in enumerate(names):
            row = by_name.get(name)
            if row is None:
                continue
            parts = {part: row[part] or 0 for part in PARTS}
            whole = sum(parts.values())
            left = 0.0
            for part, seconds in parts.items():
                share = 100 * seconds / whole
                axes.barh(place, share, left=left, height=0.72, color=PARTS[part])
                left += share
            axes.text(102, place, time_text(row["seconds"]), va="center", fontsize=6.5)
        axes.set_yticks(range(len(names)), names)
        axes.set_ylim(len(names) - 0.4, -0.6)
        axes.set_xlim(0, 100)
        axes.set_xticks([0, 25, 50, 75, 100])
        axes.set_title(common.words(own[0], titles), loc="left")
        axes.set_xlabel("share of a frame's time (%)")
        axes.tick_params(axis="y", length=0)
    used = [p for p in PARTS if any(r[p] for own in greatest.values() for r in own)]
    common.legend_below(figure, [Patch(color=PARTS[p], label=p.replace("_", " ")) for p in used])
    return figure


draw.needs = "broad phases"


if __name__ == "__main__":
    sys.exit(common.run({"phases": draw}, __doc__))

"""Speed-up by the number of threads, with 95 % intervals, beside the ideal."""

import sys

from matplotlib.lines import Line2D

import common

KEY = ["scene", "bodies", "boxes", "rebuild", "isa_limit", "seed"]


def draw(tables):
    rows = [r for r in tables["speed_ups"] if not r["task"]]
    inputs = {}
    for row in rows:
        inputs.setdefault(tuple(row[c] for c in KEY), []).append(row)
    if not inputs:
        return None
    shown = [own[0] for own in inputs.values()]
    titles = ["scene"] + common.varying(shown, KEY[1:])
    styles = tables.styles()
    figure, panels = common.grid(len(inputs), 2.0, sharey=True)
    used = set()
    threads = sorted({r["threads"] for r in rows})
    for axes, own in zip(panels, inputs.values()):
        base = own[0]["base_threads"]
        axes.plot(threads, [t / base for t in threads], color="#999999", linestyle=":", zorder=1)
        # What has one number of threads only has no speed-up.
        names = [n for n in common.in_order(r["algorithm"] for r in own)
                 if len({r["threads"] for r in own if r["algorithm"] == n}) > 1]
        for i, name in enumerate(names):
            points = sorted((r for r in own if r["algorithm"] == name), key=lambda r: r["threads"])
            # Beside each other, so that no interval hides another.
            step = 0.02 * (i - (len(names) - 1) / 2)
            x = [r["threads"] * 2**step for r in points]
            y = [r["speed_up"] for r in points]
            down = [0 if r["speed_up_low"] is None else r["speed_up"] - r["speed_up_low"]
                    for r in points]
            up = [0 if r["speed_up_high"] is None else r["speed_up_high"] - r["speed_up"]
                  for r in points]
            axes.errorbar(x, y, yerr=[down, up], capsize=1.5, elinewidth=0.7, capthick=0.7,
                          **styles[name])
            used.add(name)
        axes.set_xscale("log", base=2)
        axes.set_xticks(threads, [str(int(t)) for t in threads])
        axes.minorticks_off()
        axes.margins(x=0.12)
        axes.grid(True)
        axes.set_title(common.words(own[0], titles), loc="left")
        axes.set_xlabel("threads")
    for axes in panels:
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel(f"speed-up over {int(rows[0]['base_threads'])} thread")
    handles = [Line2D([], [], label=n, **styles[n]) for n in styles if n in used]
    handles.append(Line2D([], [], color="#999999", linestyle=":", label="ideal"))
    common.legend_below(figure, handles)
    return figure


draw.needs = "several numbers of threads"


if __name__ == "__main__":
    sys.exit(common.run({"speed_up": draw}, __doc__))

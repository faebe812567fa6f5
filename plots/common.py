"""What the figures share: the tables that they are drawn from, their style, and how they are saved.

The program computes every number (`touchstone show --tables`), so that a figure and a table cannot disagree.
"""

import argparse
import contextlib
import csv
import io
import math
import os
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update(
    {
        "svg.hashsalt": "touchstone",  # the same bytes each time
        "pdf.fonttype": 42,  # TrueType: publishers refuse Type 3
        "ps.fonttype": 42,
        "font.family": "DejaVu Sans",  # comes with matplotlib: the same on every machine
        "font.size": 7.5,
        "axes.titlesize": 8,
        "axes.labelsize": 7.5,
        "xtick.labelsize": 7,
        "ytick.labelsize": 7,
        "legend.fontsize": 7,
        "axes.linewidth": 0.6,
        "lines.linewidth": 1.0,
        "lines.markersize": 3.6,
        "xtick.major.width": 0.6,
        "ytick.major.width": 0.6,
        "xtick.minor.width": 0.4,
        "ytick.minor.width": 0.4,
        "grid.linewidth": 0.4,
        "grid.color": "#dddddd",
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "figure.dpi": 100,
        "savefig.dpi": 300,
    }
)
from matplotlib import pyplot  # noqa: E402  (after the backend is chosen)

PAGE_WIDTH = 7.16  # inches: two columns of a journal's page

# Okabe and Ito's palette: told apart with every kind of colour vision, and mostly in grey.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000", "#E69F00"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]


class BadRequest(Exception):
    """Told to the user; exit status 2."""


def has_rows(path):
    """Whether a file of rows is there, plain or packed by zstd."""
    return os.path.exists(path) or os.path.exists(path + ".zst")


@contextlib.contextmanager
def open_rows(path):
    """The text of a file of rows; where it is not there but packed by zstd, that program unpacks it."""
    packed = path + ".zst"
    if os.path.exists(path) or not os.path.exists(packed):
        with open(path, newline="", encoding="utf-8") as file:
            yield file
        return
    try:
        unpacking = subprocess.Popen(["zstd", "-dcq", "--", packed], stdout=subprocess.PIPE)
    except FileNotFoundError:
        raise BadRequest(f"{packed} is packed, and the program that unpacks it is not here (Debian: zstd)") from None
    with unpacking:
        with io.TextIOWrapper(unpacking.stdout, newline="", encoding="utf-8") as file:
            yield file
    if unpacking.returncode != 0:
        raise BadRequest(f"{packed}: cannot be unpacked")


TEXTS = {"scene", "scene_hash", "seed", "boxes", "task", "pair_kind", "pairs_of", "isa_limit", "algorithm",
         "baseline", "origin", "unit", "failure", "winner", "runner_up", "counts"}


def read_table(folder, name, texts=frozenset(TEXTS)):
    """The rows of NAME.csv, numbers as floats, empty fields as None; the columns in `texts` hold text."""
    path = os.path.join(folder, name + ".csv")
    rows = []
    try:
        with open_rows(path) as file:
            for row in csv.DictReader(file):
                for column, text in row.items():
                    if column not in texts:
                        row[column] = float(text) if text else None
                rows.append(row)
    except FileNotFoundError:
        raise BadRequest(f"{path} is missing; `touchstone show RESULTS --tables` writes it") from None
    except (ValueError, TypeError) as error:
        raise BadRequest(f"{path}: {error}") from None
    return rows


def styles_of(rows):
    """A style for each algorithm in the rows: ours filled and solid, others open and dashed."""
    ours, others = [], []
    for row in rows:
        names = ours if row["origin"] == "ours" else others
        if row["algorithm"] not in names:
            names.append(row["algorithm"])
    styles = {}
    for names, line, filled in ((ours, "-", True), (others, "--", False)):
        for i, name in enumerate(names):
            colour = COLOURS[i % len(COLOURS)]
            styles[name] = {
                "color": colour,
                "linestyle": line,
                "marker": MARKERS[(i + i // len(COLOURS)) % len(MARKERS)],
                "markerfacecolor": colour if filled else "white",
                "markeredgewidth": 0.8,
            }
    return styles


class Tables:
    """The tables of a results folder, read when they are asked for."""

    def __init__(self, folder):
        self.folder = folder
        self._rows = {}

    def __getitem__(self, name):
        if name not in self._rows:
            self._rows[name] = read_table(self.folder, name)
        return self._rows[name]

    def styles(self, narrow=False):
        """A style for each algorithm: the same in every figure that is drawn from these tables."""
        return styles_of([row for row in self["times"] if bool(row["task"]) == narrow])


def in_order(values):
    """Each value once, in the order of its first appearance."""
    return list(dict.fromkeys(values))


def varying(rows, columns):
    """Those of the columns that hold more than one value: only they are worth a word in a title."""
    return [column for column in columns if len({row[column] for row in rows}) > 1]


def words(row, columns):
    """For a title: uniform, loose boxes, 2 threads."""
    forms = {
        "scene": lambda v: v.replace("_", " "),
        "bodies": lambda v: f"{int(v):,} bodies",
        "boxes": lambda v: v + " boxes",
        "threads": lambda v: "1 thread" if v == 1 else f"{int(v)} threads",
        "seed": lambda v: "seed " + v,
        "rebuild": lambda v: "rebuilt" if v else "updated",
        "isa_limit": lambda v: v + " instructions",
    }
    return ", ".join(forms.get(c, str)(row[c]) for c in columns if row[c] not in (None, ""))


def grid(panels, height, columns=3, **options):
    """A figure of so many panels, and their axes; those that are left over are not shown."""
    columns = min(columns, panels)
    lines = math.ceil(panels / columns)
    figure, axes = pyplot.subplots(
        lines, columns, figsize=(PAGE_WIDTH, height * lines), squeeze=False,
        constrained_layout=True, **options)
    axes = list(axes.flat)
    for spare in axes[panels:]:
        spare.set_visible(False)
    return figure, axes[:panels]


def legend_below(figure, handles, columns=5):
    """One legend for all panels, under them; `save` keeps what stands outside of the figure."""
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.01),
                  ncol=min(columns, len(handles)), frameon=False, handlelength=3.2)


def save(figure, folder, name):
    """NAME.svg, NAME.pdf and NAME.png, with nothing in them that differs from day to day."""
    nothing = {
        "svg": {"Date": None, "Creator": None},
        "pdf": {"CreationDate": None, "ModDate": None, "Creator": None, "Producer": None},
        "png": {"Software": None},
    }
    paths = []
    for ending, metadata in nothing.items():
        path = os.path.join(folder, f"{name}.{ending}")
        figure.savefig(path, metadata=metadata, bbox_inches="tight", pad_inches=0.03)
        paths.append(path)
    pyplot.close(figure)
    return paths


def save_all(figures, source, out):
    """Draws each figure of the source; how many there were."""
    drawn = 0
    for name, draw in figures.items():
        figure = draw(source)
        if figure is None:
            needs = getattr(draw, "needs", None)
            print(f"{name}: nothing to draw in these results" + (f", which lack {needs}" if needs else ""))
            continue
        drawn += 1
        print(", ".join(save(figure, out, name)))
    return drawn


def told(work):
    """Does the work; what is wrong with the request is told on standard error. The exit status."""
    try:
        work()
    except BadRequest as error:
        print(f"touchstone: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"touchstone: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    return 0


def parser_of(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("results", help="results folder")
    parser.add_argument("--out", help="folder for the figures (default: RESULTS/figures)")
    return parser


def run_on(draw, description):
    """The command line of a script that reads a folder's rows itself: `draw` is given the folder, and
    that for its figures."""
    options = parser_of(description).parse_args()
    return told(lambda: draw(options.results, options.out or os.path.join(options.results, "figures")))


def run(figures, description, of_file=None):
    """The command line of a script. `figures`: name -> function of Tables that gives a figure, or
    None where the tables hold nothing to draw. `of_file`: name of a file -> function of a folder that
    holds it, and of the folder for its figures, which draws them instead."""
    parser = parser_of(description)
    parser.add_argument("--program", help="the built touchstone, which then writes the tables first, "
                        "beside the figures; without it those in RESULTS are taken")
    parser.add_argument("--noisy", action="store_true",
                        help="with --program: keep what was measured under noise")
    options = parser.parse_args()
    out = options.out or os.path.join(options.results, "figures")

    def work():
        folder = options.results
        if not os.path.exists(folder):
            raise BadRequest(f"{folder}: no such folder; expected results of `touchstone run`")
        for name, draw in (of_file or {}).items():
            if has_rows(os.path.join(folder, name)):
                return draw(folder, out)
        os.makedirs(out, exist_ok=True)
        if options.program:
            request = [options.program, "show", folder, "--tables", "--out", out]
            done = subprocess.run(request + (["--noisy"] if options.noisy else []),
                                  stdout=subprocess.DEVNULL, check=False)
            if done.returncode != 0:
                sys.exit(2)
            folder = out
        if save_all(figures, Tables(folder), out) == 0:
            raise BadRequest(f"{options.results}: no timed samples; nothing was drawn")

    return told(work)

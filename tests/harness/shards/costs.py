#!/usr/bin/env python3
"""What campaigns cost: plans each, does its shards one after another on this machine, which should have nothing else
to do, and merges them. Of long campaigns it can do some shards alone; the plan's estimates then say what part of the
whole they are. Writes a row for each campaign as soon as it is there; a campaign that the file has already is
left out. Core-hours are those of all processors that the shards may use, since a timed shard has its machine for
itself."""

import argparse
import csv
import datetime
import os
import pathlib
import shutil
import tempfile

from shards import measured

COLUMNS = "campaign kind units shards done plan_minutes processors core_hours merge_seconds megabytes".split()


def hours(row):
    begun, ended = (datetime.datetime.strptime(row[name], "%Y-%m-%d %H:%M:%S UTC") for name in ("begun", "ended"))
    return (ended - begun).total_seconds() / 3600


def rows_of(file):
    with open(file, newline="") as opened:
        return list(csv.DictReader(opened))


def cost_of(program, file, shards, do, folder):
    plan, results = folder / "plan", folder / "results"
    plan_seconds, _ = measured(program, "shards", "plan", file, "--shards", shards, "--out", plan)
    planned = rows_of(plan / "shards.csv")
    chosen = sorted({len(planned) * k // do for k in range(do)})
    for shard in chosen:
        measured(program, "run", "--plan", plan, "--shard", shard, wrong_is_fine=True)
    merge_seconds, _ = measured(program, "shards", "merge", plan, "--partial", "--out", results, wrong_is_fine=True)
    facts = {row["name"]: row["value"] for row in rows_of(plan / "plan.csv")}
    done = rows_of(results / "shards.csv")
    estimates = [float(row["seconds"]) for row in planned]
    part = sum(estimates[shard] for shard in chosen) / sum(estimates)
    processors = len(os.sched_getaffinity(0))
    bytes_written = sum(path.stat().st_size for path in results.rglob("*") if path.is_file())
    return {
        "campaign": file.stem,
        "kind": facts["kind"],
        "units": planned[-1]["end"],
        "shards": len(planned),
        "done": len(done),
        "plan_minutes": f"{plan_seconds / 60:.1f}",
        "processors": processors,
        "core_hours": f"{processors * sum(map(hours, done)) / part:.3g}",
        "merge_seconds": f"{merge_seconds:.1f}",
        "megabytes": f"{bytes_written / 1e6:.1f}",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    parser.add_argument("out", type=pathlib.Path, help="the file, which rows are added to")
    parser.add_argument("campaigns", type=pathlib.Path, nargs="+")
    parser.add_argument("--shards", type=int, default=4)
    parser.add_argument("--do", type=int, help="how many of them are done (default: all)")
    options = parser.parse_args()
    known = [row["campaign"] for row in rows_of(options.out)] if options.out.exists() else []
    program = os.path.abspath(options.program)
    for campaign in options.campaigns:
        if campaign.stem in known:
            continue
        folder = pathlib.Path(tempfile.mkdtemp(prefix="touchstone-"))
        try:
            row = cost_of(program, campaign.resolve(), options.shards, options.do or options.shards, folder)
        finally:
            shutil.rmtree(folder)
        is_new = not options.out.exists()
        with open(options.out, "a", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            if is_new:
                writer.writeheader()
            writer.writerow(row)


if __name__ == "__main__":
    main()

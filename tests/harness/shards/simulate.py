#!/usr/bin/env python3
"""How `plan`, `status` and `merge` grow with the number of shards, and `merge` with the number of rows: plans a
soak, lets a pretended array do its shards by writing what a shard leaves, and merges them. Writes a row for
each size: seconds, and the most memory of the process in megabytes, which has that of this script as its least."""

import argparse
import csv
import os
import pathlib
import shutil
import tempfile
import time

from shards import measured

COLUMNS = (
    "shards rows files plan_seconds plan_mb array_seconds status_seconds status_mb merge_seconds merge_mb".split()
)
PAIRS_A_JOB = 1000


def write_soak(file, jobs):
    file.write_text(f'[soak]\npairs = {jobs * PAIRS_A_JOB}\nnarrow = "certified"\nscalars = "double"\n')


def path_of(plan, shard, first, end):
    """The folder of a shard's only part."""
    return plan / "shards" / str(shard // 1000) / str(shard) / f"part-{first}-{end}"


def id_of(plan):
    with open(plan / "plan.csv", newline="") as file:
        return next(row["value"] for row in csv.DictReader(file) if row["name"] == "id")


def mixed(x):
    x = (x + 0x9E3779B97F4A7C15) % 2**64
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB % 2**64
    return x ^ (x >> 31)


def hash_of(text):
    """The hash of rows in progress.csv (harness/base/hash.h)."""
    content = text.encode()
    state = 0
    for at in range(0, len(content), 8):
        state = mixed(state ^ int.from_bytes(content[at : at + 8].ljust(8, b"\0"), "little"))
    return f"{mixed(state ^ len(content)):016x}"


class Model:
    """What a shard that was done leaves, as texts with holes."""

    def __init__(self, program, folder):
        """Does the only shard of a plan that is as small as can be."""
        write_soak(folder / "model.toml", 1)
        plan = folder / "model"
        measured(program, "shards", "plan", folder / "model.toml", "--shards", 1, "--out", plan)
        measured(program, "run", "--plan", plan, "--shard", 0)
        part = path_of(plan, 0, 0, 1)
        self.machine = (part / "machine.csv").read_text()
        self.id = id_of(plan)
        self.attempts = (part.parent / "attempts.csv").read_text()
        self.families = (part / "families.csv").read_text()
        self.header, self.row = (part / "jobs.csv").read_text().splitlines(keepends=True)[:2]
        shutil.rmtree(plan)

    def do_all(self, plan, rows):
        """Writes what all shards of the plan would leave, with so many rows each."""
        machine = self.machine.replace(self.id, id_of(plan))
        with open(plan / "shards.csv", newline="") as file:
            for row in csv.DictReader(file):
                self.do(plan, machine, int(row["shard"]), int(row["first"]), int(row["end"]), rows)

    def do(self, plan, machine, shard, first, end, rows):
        part = path_of(plan, shard, first, end)
        part.mkdir(parents=True)
        (part.parent / "lock").touch()
        (part.parent / "attempts.csv").write_text(self.attempts)
        facts = machine.replace("part,0-1\n", f"part,{first}-{end}\n").replace("shard,0\n", f"shard,{shard}\n")
        (part / "machine.csv").write_text(facts)
        text = self.header + self.row * rows
        (part / "jobs.csv").write_text(text)
        (part / "families.csv").write_text(self.families)
        belonging = f"{end - first}\n{id_of(plan)}\n{shard}\n{first}-{end}"
        progress = f"name,value\nunits,{end - first}\n"
        for name, content in (("jobs.csv", text), ("families.csv", self.families)):
            progress += f"{name},{len(content)}\n{name} hash,{hash_of(content + belonging)}\n"
        (part / "progress.csv").write_text(progress)


def simulate(program, model, shards, rows, folder):
    soak, plan, out = folder / "soak.toml", folder / "plan", folder / "out"
    write_soak(soak, max(1, rows // 1000) * shards)
    found = {"shards": shards, "rows": shards * rows}
    found["plan_seconds"], found["plan_mb"] = measured(program, "shards", "plan", soak, "--shards", shards, "--out", plan)
    begin = time.monotonic()
    model.do_all(plan, rows)
    found["array_seconds"] = time.monotonic() - begin
    found["files"] = sum(len(files) for _, _, files in os.walk(plan))
    found["status_seconds"], found["status_mb"] = measured(program, "shards", "status", plan)
    found["merge_seconds"], found["merge_mb"] = measured(program, "shards", "merge", plan, "--out", out)
    for made in (plan, out):
        shutil.rmtree(made)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    parser.add_argument("--shards", type=int, nargs="+", default=[1000, 10_000, 100_000])
    parser.add_argument("--rows", type=int, nargs="*", default=[10_000, 100_000], help="of each of 100 shards")
    parser.add_argument("--out", default="/dev/stdout")
    options = parser.parse_args()
    sizes = [(shards, 0) for shards in options.shards] + [(100, rows) for rows in options.rows]
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name, open(options.out, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        folder = pathlib.Path(name)
        model = Model(options.program, folder)
        for shards, rows in sizes:
            found = simulate(options.program, model, shards, rows, folder)
            table.writerow({key: f"{value:.3g}" if isinstance(value, float) else value for key, value in found.items()})
            file.flush()


if __name__ == "__main__":
    main()

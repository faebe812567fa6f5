#!/usr/bin/env python3
"""How `plan`, `status` and `merge` grow with the number of shards, and `merge` with the number of rows: plans a
soak, lets a pretended array do its shards by writing what a shard leaves, and merges them. Writes a row for
each size: seconds, and the most memory of the process in megabytes."""

import argparse
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

COLUMNS = (
    "shards rows files plan_seconds plan_mb array_seconds status_seconds status_mb merge_seconds merge_mb".split()
)
PAIRS_A_JOB = 1000


def measured(*words):
    """Seconds and megabytes of a command."""
    begin = time.monotonic()
    with subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"simulate: {' '.join(map(str, words))} ended with status {process.returncode}")
    return time.monotonic() - begin, usage.ru_maxrss / 1024


def write_soak(file, jobs):
    file.write_text(f'[soak]\npairs = {jobs * PAIRS_A_JOB}\nnarrow = "certified"\nscalars = "double"\n')


class Array:
    """Writes the folders of shards as one that was done left its own, with other numbers."""

    def __init__(self, plan):
        self.plan = plan
        with open(plan / "shards.csv", newline="") as file:
            self.shards = [(int(row["shard"]), int(row["first"]), int(row["end"])) for row in csv.DictReader(file)]
        folder = self.folder(0)
        part = self.part(folder, *self.shards[0][1:])
        self.machine = (part / "machine.csv").read_text()
        self.attempts = (folder / "attempts.csv").read_text()
        lines = (part / "jobs.csv").read_text().splitlines(keepends=True)
        self.header, self.row = lines[0], lines[1]

    def folder(self, shard):
        return self.plan / "shards" / str(shard // 1000) / str(shard)

    @staticmethod
    def part(folder, first, end):
        return folder / f"part-{first}-{end}"

    def do(self, shard, first, end, rows):
        folder = self.folder(shard)
        part = self.part(folder, first, end)
        part.mkdir(parents=True, exist_ok=True)
        (folder / "lock").touch()
        (folder / "attempts.csv").write_text(self.attempts)
        machine = self.machine.replace(f"part,{self.shards[0][1]}-{self.shards[0][2]}\n", f"part,{first}-{end}\n")
        (part / "machine.csv").write_text(machine.replace("shard,0\n", f"shard,{shard}\n"))
        size = len(self.header)
        with open(part / "jobs.csv", "w") as file:
            file.write(self.header)
            block = self.row * 1000
            for _ in range(rows // 1000):
                size += file.write(block)
        (part / "progress.csv").write_text(f"name,value\nunits,{end - first}\njobs.csv,{size}\n")

    def do_all(self, rows):
        for shard, first, end in self.shards:
            self.do(shard, first, end, rows)


def simulate(program, shards, rows, folder):
    soak, plan, out = folder / "soak.toml", folder / "plan", folder / "out"
    write_soak(soak, max(1, rows // 1000) * shards)
    found = {"shards": shards, "rows": shards * rows}
    found["plan_seconds"], found["plan_mb"] = measured(program, "plan", soak, "--shards", shards, "--out", plan)
    # One real shard, of a plan that is as small as can be, is the model of the others.
    small = folder / "small"
    write_soak(soak, 1)
    measured(program, "plan", soak, "--shards", 1, "--out", small)
    measured(program, "run", "--plan", small, "--shard", 0)
    model = Array(small)
    array = Array.__new__(Array)
    array.__dict__.update(model.__dict__)
    array.plan = plan
    with open(plan / "shards.csv", newline="") as file:
        array.shards = [(int(row["shard"]), int(row["first"]), int(row["end"])) for row in csv.DictReader(file)]
    ids = [dict(line.split(",")[1:3] for line in (p / "plan.csv").read_text().splitlines())["id"] for p in (small, plan)]
    array.machine = model.machine.replace(ids[0], ids[1]).replace("part,0-1\n", "part,%s-%s\n" % array.shards[0][1:])
    begin = time.monotonic()
    array.do_all(rows)
    found["array_seconds"] = time.monotonic() - begin
    found["files"] = sum(len(files) for _, _, files in os.walk(plan))
    found["status_seconds"], found["status_mb"] = measured(program, "status", plan)
    found["merge_seconds"], found["merge_mb"] = measured(program, "merge", plan, "--out", out)
    for made in (plan, small, out):
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
        for shards, rows in sizes:
            found = simulate(options.program, shards, rows, pathlib.Path(name))
            table.writerow({key: f"{value:.3g}" if isinstance(value, float) else value for key, value in found.items()})
            file.flush()


if __name__ == "__main__":
    main()

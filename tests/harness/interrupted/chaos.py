#!/usr/bin/env python3
"""For some time draws commands and their inputs at random, and disturbs each: kills it, fills its disk, damages the
files that it left, and lets it go on. In the end each has the results of the same command that nobody disturbed.

By hand, for an hour on two processors, in two processes:

    tests/harness/interrupted/chaos.py build/release/harness/touchstone --seconds 3600 --seed 1 &
    tests/harness/interrupted/chaos.py build/release/harness/touchstone --seconds 3600 --seed 2
"""

import argparse
import collections
import math
import os
import pathlib
import random
import shutil
import signal
import sys
import tempfile
import time

from full_disk import begin_own_mounts, small_disk
from interrupted import Fault, expect, expect_same, run_command
from kill_and_resume import run_and_kill

PAGE = 4096
ROOM = 1 << 28  # of the disk where it is not meant to be full
MOST_DISTURBANCES = 8  # of one command; then it is left alone
BROAD = ("naive", "sweep-one-axis", "uniform-grid", "packed-rtree", "loose-octree", "dynamic-bvh")
NARROW = ("gjk", "sat", "mpr", "closed-form", "gjk-textbook")
AXES = ("aspect", "coplanar", "depth", "distance", "gap", "parallel", "ratio", "scale-down", "vertices")
KINDS = ("pair", "ray", "point", "mesh", "cast", "feature", "box", "scene-ray")


class Job:
    """One command. `resume` are the words by which it goes on in a folder in which it was stopped."""

    def __init__(self, kind, out, before, after=(), resume=()):
        self.kind, self.out, self.before, self.after, self.resume = kind, out, before, after, resume

    def words(self, folder):
        out = folder / self.out
        goes_on = self.resume if (out / "machine.csv").exists() else ()
        return [*map(str, self.before), str(out), *map(str, self.after), *goes_on]

    def expect_same(self, folder, whole):
        if self.kind == "run":
            return expect_same(folder / self.out, whole / self.out)
        contents = [contents_of(part) for part in (folder, whole)]
        expect(contents[0].keys() == contents[1].keys(), f"files: {sorted(contents[0])}; expected {sorted(contents[1])}")
        for name, content in contents[0].items():
            expect(content == contents[1][name], f"{name} is not that of an undisturbed {self.kind}")


def contents_of(folder):
    """The files below `folder`, without its name and without what tells of a machine and its times."""
    return {
        str(file.relative_to(folder)): file.read_bytes().replace(str(folder).encode(), b"")
        for file in folder.rglob("*")
        if file.is_file() and file.name not in ("machine.csv", "progress.csv")
    }


def draw_scene(draw, inputs, frames):
    shapes = draw.sample(("box", "sphere", "capsule", "cylinder", "cone", "ellipsoid"), draw.randint(1, 3))
    scene = inputs / f"scene-{draw.getrandbits(32):08x}.toml"
    scene.write_text(
        f'generator = "uniform"\ncount = {draw.randint(2, 60)}\noverlaps = {draw.choice((0.1, 1, 4))}\n'
        f"frames = {frames}\nseed = {draw.getrandbits(30)}\nshapes = {list(shapes)}\n".replace("'", '"')
    )
    return scene


def draw_run(draw, inputs):
    names = [draw.sample(BROAD, draw.randint(1, 3)), draw.sample(NARROW, draw.randint(1, 3))]
    campaign = inputs / f"campaign-{draw.getrandbits(32):08x}.toml"
    lines = [
        'name = "chaos"',
        f'scenes = "{draw_scene(draw, inputs, draw.randint(1, 5)).name}"',
        f'broad = {["naive", *names[0]]}',
        f'scalars = "{draw.choice(("double", "float"))}"',
        "squares = 6\nlimit = true\nseconds = 0.02",
        f"threads = {draw.randint(1, 2)}\nseed = {draw.getrandbits(30)}",
        "[[group]]",
        f"narrow = {names[1]}",
        f'tasks = {draw.sample(("intersect", "distance", "penetration"), draw.randint(1, 2))}',
    ]
    if draw.random() < 0.5:
        lines += ["[[group]]", f"rebuild = true\nthreads = {draw.randint(1, 2)}"]
    campaign.write_text("\n".join(lines).replace("'", '"') + "\n")
    return Job("run", "out", ["run", campaign, "--out"], resume=["--resume"])


def draw_check(draw, inputs):
    kind = draw.choice(KINDS)
    words = ["check", "--kind", kind, "--seed", draw.getrandbits(30), "--cases", draw.randint(1, 4), "--threads", 2]
    return Job("check", "out", [*words, "--out"], resume=["--resume"])


def draw_axes(draw, inputs):
    words = ["check", "--axes", draw.choice(AXES), "--cases", 1, "--seed", draw.getrandbits(30), "--with", draw.choice(NARROW)]
    return Job("check --axes", "out", [*words, "--out"], resume=["--resume"])


def draw_count(draw, inputs):
    words = ["check", "--count", draw.randint(1, 9) * 1000, "--seed", draw.getrandbits(30), "--kind", "pair"]
    return Job("check --count", "out", [*words, "--out"], resume=["--resume"])


def draw_record(draw, inputs):
    scene = draw_scene(draw, inputs, draw.randint(1, 200))
    return Job("scene record", draw.choice(("out.csv", "out.aabbs")), ["scene", "record", scene, "--out"])


def draw_picture(draw, inputs):
    return Job("scene draw", "out.png", ["scene", "draw", draw_scene(draw, inputs, 1), "--out"])


def draw_query(draw, inputs):
    boxes = inputs / f"boxes-{draw.getrandbits(32):08x}.csv"
    rows = ["frame,id,min_x,min_y,min_z,max_x,max_y,max_z"]
    for frame in range(draw.randint(1, 4)):
        for body in range(draw.randint(1, 40)):
            low = [draw.uniform(0, 4) for _ in range(3)]
            rows.append(",".join(map(str, (frame, body, *low, *(value + draw.uniform(0, 2) for value in low)))))
    boxes.write_text("\n".join(rows) + "\n")
    # Its answers have times: of these the pairs are compared.
    return Job("query", "pairs.csv", ["query", boxes, "--with", ",".join(draw.sample(BROAD, 2)),
                                      "--out", os.devnull, "--pairs"])


DRAWN = {draw_run: 6, draw_check: 4, draw_axes: 1, draw_count: 2, draw_record: 1, draw_picture: 1, draw_query: 1}


def bytes_below(folder):
    return sum(-(-file.stat().st_size // PAGE) * PAGE for file in folder.rglob("*") if file.is_file())


class Chaos:
    """Disturbs commands, and counts what it did."""

    def __init__(self, program, draw, folder, disk):
        self.program, self.draw, self.folder, self.disk = program, draw, folder, disk
        self.counts = collections.Counter()
        self.of_kind = collections.Counter()

    def kill(self, job, life):
        wait = math.exp(self.draw.uniform(math.log(0.002), math.log(max(0.01, life))))
        output = self.folder / "output"
        words = [self.program, *job.words(self.disk.folder)]
        status = run_and_kill(words, output, wait, self.draw.random() < 0.5)
        if status == -signal.SIGKILL:
            self.counts["kills"] += 1
            return False
        expect(status == 0, f"{words}: status {status}\n{output.read_text()}")
        return True

    def fill(self, job):
        """The disk has room for a few pages more."""
        self.disk.resize(bytes_below(self.disk.folder) + self.draw.randint(3, 12) * PAGE)
        words = job.words(self.disk.folder)
        status, text = run_command(self.program, *words)
        self.disk.resize(ROOM)
        if status != 0:
            expect(status == 2 and "No space left on device" in text and str(self.disk.folder) in text,
                   f"{words}, on a full disk: status {status}\n{text}")
            self.counts["full disks"] += 1
        return status == 0

    def damage(self, job):
        """A file loses its end, has the zeros of a power failure, or is gone. The command refuses it by name, or
        makes it again."""
        files = sorted(file for file in self.disk.folder.rglob("*") if file.is_file())
        if not files or not job.resume:
            return False
        file = self.draw.choice(files)
        content = file.read_bytes()
        place = self.draw.randint(0, len(content))
        how = self.draw.choice(("cut", "zeros", "gone", "more"))
        if how == "gone":
            file.unlink()
        else:
            tail = {"cut": b"", "zeros": bytes(len(content) - place), "more": content[place:] + b"0,half of a li"}
            file.write_bytes(content[:place] + tail[how])
        self.counts["files damaged"] += 1
        words = job.words(self.disk.folder)
        status, text = run_command(self.program, *words)
        if status == 2:
            expect(str(self.disk.folder / job.out) in text, f"{words}, {file.name} ({how}): no place in\n{text}")
            self.counts["of these refused"] += 1
            file.write_bytes(content)
            return False
        expect(status == 0, f"{words}, {file.name} ({how}): status {status}\n{text}")
        return True

    def one_command(self):
        inputs = self.folder / "inputs"
        inputs.mkdir()
        job = self.draw.choices(list(DRAWN), list(DRAWN.values()))[0](self.draw, inputs)
        whole = self.folder / "whole"
        whole.mkdir()
        begin = time.monotonic()
        words = job.words(whole)
        status, text = run_command(self.program, *words)
        expect(status == 0, f"{words}, undisturbed: status {status}\n{text}")
        life = time.monotonic() - begin
        done = False
        last = ""
        for _ in range(self.draw.randint(1, MOST_DISTURBANCES)):
            last = self.draw.choices(("kill", "fill", "damage"), (5, 2, 2))[0]
            done = {"kill": lambda: self.kill(job, life), "fill": lambda: self.fill(job),
                    "damage": lambda: self.damage(job)}[last]()
            if done:
                break
        if not done:
            words = job.words(self.disk.folder)
            status, text = run_command(self.program, *words)
            expect(status == 0, f"{words}, in the end: status {status}\n{text}")
        try:
            job.expect_same(self.disk.folder, whole)
        except Fault as fault:
            raise Fault(f"{words}: {fault} (disturbed last: {last})") from fault
        self.counts["commands"] += 1
        self.of_kind[job.kind] += 1
        for part in (whole, inputs):
            shutil.rmtree(part)
        for part in self.disk.folder.iterdir():
            shutil.rmtree(part) if part.is_dir() else part.unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the built touchstone", type=lambda name: str(pathlib.Path(name).resolve()))
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--least", type=int, default=1, help="kills, and full disks, without which it has shown nothing")
    options = parser.parse_args()
    begin_own_mounts()
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name:
        folder = pathlib.Path(name)
        with small_disk(folder / "disk") as disk:
            disk.resize(ROOM)
            chaos = Chaos(options.program, random.Random(options.seed), folder, disk)
            end = time.monotonic() + options.seconds
            while time.monotonic() < end or min(chaos.counts["kills"], chaos.counts["full disks"]) < options.least:
                chaos.one_command()
            counts, of_kind = ({name: counter[name] for name in sorted(counter)} for counter in (chaos.counts, chaos.of_kind))
            print(f"{counts}; {of_kind}; each ended with the results of an undisturbed command")


if __name__ == "__main__":
    try:
        main()
    except Fault as fault:
        sys.exit(f"chaos: {fault}")

#!/usr/bin/env python3
"""Kills a campaign at random moments and resumes it, until it comes to its end, again and again: each
time it ends with the rows of a run that nobody disturbed. Half of the kills take the whole process
group, half the program alone: its workers have to end with it."""

import argparse
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from interrupted import Fault, command, expect, expect_none_left, expect_same, read, run


def run_and_kill(arguments, output, wait, whole_group):
    """The exit status; `wait` None: it is not killed."""
    with open(output, "w") as file:
        process = subprocess.Popen(arguments, stdout=file, stderr=file, start_new_session=True)
    try:
        process.wait(wait)
    except subprocess.TimeoutExpired:
        if whole_group:
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
        process.wait()
    expect_none_left(process.pid)
    return process.returncode


def lines(file):
    return len(file.read_bytes().splitlines()) if file.exists() else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    draw = random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name:
        whole, cut, output = (pathlib.Path(name, part) for part in ("whole", "cut", "output"))
        begin = time.monotonic()
        status, text = run(options.program, whole)
        life = time.monotonic() - begin
        expect(status == 0, f"the undisturbed run: status {status}\n{text}")
        expect_same(whole, whole)
        ended = 0
        kills = []  # lines of raw.csv at each
        while len(kills) < options.kills or cut.exists():
            flags = ["--resume"] if (cut / "machine.csv").exists() else []
            expect(flags or not (cut / "raw.csv").exists(), "rows, and no machine.csv that tells whose they are")
            # As many kills among the first milliseconds as about the middle of its life.
            wait = math.exp(draw.uniform(math.log(0.002), math.log(life))) if len(kills) < options.kills else None
            status = run_and_kill(command(options.program, cut, *flags), output, wait, draw.random() < 0.5)
            if status == -signal.SIGKILL:
                kills.append(lines(cut / "raw.csv"))
                continue
            expect(status == 0, f"after {len(kills)} kills: status {status}\n{output.read_text()}")
            expect_same(cut, whole)
            shutil.rmtree(cut)
            ended += 1
        print(
            f"{len(kills)} kills, at {min(kills, default=0)} to {max(kills, default=0)} of {len(read(whole))} rows; "
            f"{ended} runs came to their end, with the rows of an undisturbed one"
        )


if __name__ == "__main__":
    try:
        main()
    except Fault as fault:
        sys.exit(f"kill_and_resume: {fault}")

#!/usr/bin/env python3
"""Kills the making of a plan, its shards and their merge at random moments, each again and again until it comes
to its end: what is left then is what a run that nobody disturbed leaves. Half of the kills take the whole
process group, half the program alone."""

import argparse
import math
import pathlib
import random
import shutil
import signal
import sys
import tempfile
import time

from interrupted import CAMPAIGN, Fault, expect, expect_same, run
from kill_and_resume import run_and_kill

SHARDS = 3


class Killer:
    """Runs commands and kills them until it has killed often enough."""

    def __init__(self, program, output, draw, kills):
        self.program, self.output, self.draw = program, output, draw
        self.left = kills  # number of kills to come, by kind of command
        self.life = {}  # seconds of an undisturbed command, by kind

    def __call__(self, kind, *words, before=lambda: None):
        """Runs `words` until they come to their end."""
        while True:
            before()
            wait = None
            if self.left[kind] > 0 and kind in self.life:
                # As many kills among the first milliseconds as about the middle of its life.
                wait = math.exp(self.draw.uniform(math.log(0.002), math.log(self.life[kind])))
            begin = time.monotonic()
            status = run_and_kill([self.program, *map(str, words)], self.output, wait, self.draw.random() < 0.5)
            if status == -signal.SIGKILL:
                self.left[kind] -= 1
                continue
            expect(status == 0, f"{' '.join(map(str, words))}: status {status}\n{self.output.read_text()}")
            if wait is None:
                self.life[kind] = max(0.01, time.monotonic() - begin)
            return


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    parser.add_argument("--kills", type=int, default=50, help="of each of plan, run and merge")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name:
        whole, plan, merged, output = (pathlib.Path(name, part) for part in ("whole", "plan", "merged", "output"))
        status, text = run(options.program, whole)
        expect(status == 0, f"the undisturbed run: status {status}\n{text}")
        kills = dict.fromkeys(("plan", "run", "merge"), options.kills)
        killer = Killer(options.program, output, random.Random(options.seed), kills)
        rounds = 0
        while rounds < 2 or any(count > 0 for count in killer.left.values()):
            killer("plan", "shards", "plan", CAMPAIGN, "--shards", SHARDS, "--out", plan)
            for shard in range(SHARDS):
                killer("run", "run", "--plan", plan, "--shard", shard)
            while True:
                killer("merge", "shards", "merge", plan, "--out", merged)
                expect_same(merged, whole, of_shards=True)
                left = sorted(p.name for p in merged.parent.iterdir())
                expect(left == ["merged", "output", "plan", "whole"], f"left behind: {left}")
                if killer.left["merge"] <= 0 or killer.left["run"] > 0:
                    break
            shutil.rmtree(plan)
            shutil.rmtree(merged)
            rounds += 1
        print(f"{options.kills} kills of each of plan, run and merge in {rounds} rounds; each round ended with the "
              "rows of an undisturbed run")


if __name__ == "__main__":
    try:
        main()
    except Fault as fault:
        sys.exit(f"kill_shards: {fault}")

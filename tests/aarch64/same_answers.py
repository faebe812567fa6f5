#!/usr/bin/env python3
"""Holds what two runs of a campaign found, on two machines, against each other: pairs, answers, hashes and counters.

usage: same_answers.py HERE THERE

Algorithms of libraries are left out.
"""

import collections
import csv
import pathlib
import sys

# A row of a check is told by these,
WHICH = "block scene scene_hash frame broad narrow scalar task tolerance threads rebuild pair_kind phase part_pairs".split()
# and these do not depend on the machine.
ANSWERS = ("pair_count pair_hash contact_count outcome_hash compared disagreements worst_disagreement worst_error failures "
           "iterations iterations_squared support_calls box_tests node_visits candidates status").split()


def rows_of(folder):
    rows = {}
    with open(pathlib.Path(folder, "raw.csv"), newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["kind"] == "check" and row["origin"] != "peer":
                which = tuple(row[name] for name in WHICH)
                if which in rows:
                    sys.exit(f"{file.name}: two rows of {dict(zip(WHICH, which))}")
                rows[which] = row
    return rows


def main():
    here, there = (rows_of(folder) for folder in sys.argv[1:3])
    if len(here) < 10 or here.keys() != there.keys():
        sys.exit(f"{len(here)} rows of checks of ours here, {len(there)} there; {len(here.keys() ^ there.keys())} on one side alone")
    columns = collections.Counter()
    examples = {}
    for which, row in here.items():
        for name in ANSWERS:
            if row[name] != there[which][name]:
                columns[name] += 1
                examples.setdefault(name, f"{dict(zip(WHICH, which))}: {row[name]} here, {there[which][name]} there")
    hashes = sum(bool(row["pair_hash"]) + bool(row["outcome_hash"]) for row in here.values())
    print(f"{len(here)} rows of checks with {hashes} hashes; differing in " + (", ".join(
        f"{name}: {count}" for name, count in columns.items()) or "none of the columns"))
    for example in examples.values():
        print("  " + example)
    sys.exit(1 if columns else 0)


if __name__ == "__main__":
    main()

"""What the scripts beside this file share: runs of the small campaign, and comparing what they leave."""

import csv
import os
import pathlib
import re
import subprocess
import time

CAMPAIGN = pathlib.Path(__file__).with_name("campaign.toml")
MODULUS = 2**64

# What tells a row from the others, and what does not depend on the machine's mood. How many frames a
# sample has does: it is chosen by the time that the check took.
IDENTITY = (
    "campaign kind block scene scene_hash seed bodies boxes broad narrow scalar task tolerance twin "
    "threads isa pair_kind process square round position phase status words stop"
).split()
ANSWERS = (
    "frame frames pair_count pair_hash contact_count outcome_hash compared disagreements "
    "worst_disagreement worst_error failures iterations support_calls"
).split()


class Fault(Exception):
    """What was found is not what is expected."""


def expect(holds, message):
    if not holds:
        raise Fault(message)


def command(program, folder, *flags):
    return [program, "run", str(CAMPAIGN), "--out", str(folder), *flags]


def run_command(*words):
    """A command that is left alone: its exit status and what it printed."""
    ran = subprocess.run(
        [str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    return ran.returncode, ran.stdout


def run(program, folder, *flags):
    """A run that is left alone: its exit status and what it printed."""
    return run_command(*command(program, folder, *flags))


def members(group):
    """Processes of a process group that have not ended."""
    found = []
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            stat = pathlib.Path("/proc", entry, "stat").read_text(errors="replace")
        except OSError:
            continue  # it has ended meanwhile
        state, _, group_of = stat.rpartition(")")[2].split()[:3]
        if int(group_of) == group and state not in "ZX":
            found.append(int(entry))
    return found


def expect_none_left(group, seconds=5.0):
    """A worker ends with its parent; a busy system may take a moment."""
    end = time.monotonic() + seconds
    while left := members(group):
        expect(time.monotonic() < end, f"processes are left {seconds:g} s after the kill: {left}")
        time.sleep(0.01)


def read(folder):
    with open(folder / "raw.csv", newline="") as file:
        return list(csv.DictReader(file))


def key_of_set(row):
    narrow = bool(row["narrow"])
    return row["block"], narrow, row["broad"] if narrow else "", row["task"], row["pair_kind"]


def label(row):
    return row["broad"], row["narrow"], row["scalar"], row["tolerance"]


def what_is_the_same(rows):
    """The rows in their order, without what may differ between two runs."""
    return [
        tuple(row[name] for name in (IDENTITY + ANSWERS if row["kind"] == "check" else IDENTITY)) for row in rows
    ]


def check_windows(rows):
    """Each sample is the sum over its window of what the check found."""
    checks, starts, counts, windows = {}, {}, {}, {}
    for row in rows:
        if row["kind"] != "check":
            continue
        answer = (int(row["pair_count"] or 0), int(row["pair_hash"] or "0", 16), int(row["outcome_hash"] or "0", 16))
        checks[key_of_set(row), label(row), row["phase"], int(row["frame"])] = answer
        # Of a set on other pairs than those of the frame the check may stand for the true ones.
        true_pairs = (row["block"], bool(row["narrow"]), "", row["task"], row["pair_kind"])
        checks.setdefault((true_pairs, label(row), row["phase"], int(row["frame"])), answer)
        counts[row["block"]] = max(counts.get(row["block"], 0), int(row["frame"]) + 1)
        if row["phase"] == "update":
            starts[row["block"]] = 1
    for row in rows:
        if row["kind"] != "sample" or row["phase"] not in ("find_pairs", "narrow"):
            continue
        window = windows.setdefault(key_of_set(row), row["frames"])
        expect(window == row["frames"], f"two lengths of samples in one set: {row}")
        first = 0 if row["narrow"] else starts.get(row["block"], 0)
        length = counts[row["block"]] - first
        sums = [0, 0, 0]
        found = False
        for i in range(int(row["frames"])):
            frame = first + (int(row["frame"]) - first + i) % length
            algorithm = ("", *label(row)[1:]) if row["narrow"] else label(row)
            true_pairs = (row["block"], bool(row["narrow"]), "", row["task"], row["pair_kind"])
            answer = checks.get((true_pairs, algorithm, row["phase"], frame))
            found = found or answer is not None
            for place, value in enumerate(answer or ()):
                sums[place] = (sums[place] + value) % MODULUS
        expect(found, f"a sample of what was never checked: {row}")
        expect(sums[0] == int(row["pair_count"]), f"{sums[0]} pairs in the check of {row}")
        if row["narrow"]:
            expect(sums[1] == int(row["pair_hash"], 16), f"other pairs than in the check: {row}")
            expect(sums[2] == int(row["outcome_hash"], 16), f"other answers than in the check: {row}")


# What the results of shards have beside those of a run.
OF_SHARDS = re.compile(r"blocks\.csv|shards\.csv|machines(/.*)?")


def expect_same(folder, whole, of_shards=False):
    """The folder holds what the undisturbed run's folder holds: no row lost or doubled."""
    rows, expected = read(folder), read(whole)
    identities = [tuple(row[name] for name in IDENTITY + ["frame"]) for row in rows if row["kind"] == "check"]
    identities += [tuple(row[name] for name in IDENTITY) for row in rows if row["kind"] == "sample"]
    expect(len(set(identities)) == len(identities), "a row is there twice")
    expect(len(rows) == len(expected), f"{len(rows)} rows; expected {len(expected)}")
    for place, (own, other) in enumerate(zip(what_is_the_same(rows), what_is_the_same(expected))):
        expect(own == other, f"row {place}: {own}; expected {other}")
    check_windows(rows)
    departures = [(f / "departures.csv").read_text().replace(str(f), "") for f in (folder, whole)]
    expect(departures[0] == departures[1], f"departures.csv: {departures[0]}; expected {departures[1]}")
    names = [sorted(str(p.relative_to(f)) for p in f.rglob("*")) for f in (folder, whole)]
    if of_shards:
        names[0] = [name for name in names[0] if not OF_SHARDS.fullmatch(name)]
    expect(names[0] == names[1], f"files: {names[0]}; expected {names[1]}")

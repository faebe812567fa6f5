#!/usr/bin/env python3
"""Makes a corpus of hard cases: python3 datasets/corpus/make_corpus.py OUT

Draws pairs of convex bodies by `touchstone check`, with a proof of each exact answer, and adds kept files of pairs.
Asks all algorithms of ours, all libraries and the adapters about them. Chooses those cases whose failures cover the
most, and writes OUT/cases.jsonl.zst and OUT/proofs.jsonl.zst. A corpus that is there is never written again.
It needs Python 3.8, its standard library, and the program `zstd`.

The same seed, program and libraries give the same corpus, unless a query ends at its time limit on one machine alone.
Steps that are done are kept in the folder of work, and not done again.
"""
import argparse
import concurrent.futures
import csv
import heapq
import json
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Kept pairs that are candidates too: those that libraries got wrong along axes, shrunk, and from version to version.
KEPT = ["results/stress/failures/*.jsonl", "results/versions/cases.jsonl"]
LONGEST_CASE, LONGEST_PROOF = 6_000, 12_000  # characters of a line, so that the corpus stays small
SHARD = 250  # cases of one check, which asks an algorithm no more after a hundred crashes and hangs
# Grades of answers that are no failure (results/columns.md, grades.csv).
NO_FAILURE = {"right", "near", "bound", "unresolved"}
WRONG = {"missed", "false_hit", "inexact"}


# --- candidates ------------------------------------------------------------------------------------


def touchstone(log, *arguments):
    """Runs the program from the project's folder; 1 says that something of ours is wrong, which is no failure here."""
    with open(log, "w", encoding="utf-8") as text:
        status = subprocess.run([ROOT / "touchstone", *arguments], cwd=ROOT, stdout=text, stderr=text).returncode
    if status not in (0, 1):
        sys.exit(f"touchstone {' '.join(map(str, arguments))} ended with {status}: see {log}")


def drawn_id(proof_id):
    """The id of what is drawn begins with its family, FAMILY/KINDS/DETAIL/INDEX."""
    return proof_id.split("/")[0], proof_id


def kept_id(proof_id):
    """`check FILE` calls a case FILE/KINDS/ID/INDEX, and ID may be that of what was drawn.

    >>> kept_id("found/box-box/gap-1e-9/box-box/edge-edge/17/2")
    ('gap-1e-9', 'gap-1e-9/box-box/edge-edge/17')
    >>> kept_id("cases/hull-hull/rapier/1")
    ('cases', 'rapier')
    """
    parts = proof_id.split("/")
    own = parts[2:-1]
    return own[0] if len(own) > 1 else parts[0], "/".join(own)


def sources(options):
    """(command, family and id of a case by the id of its proof) of each source of pairs. The command writes proofs."""
    drawn = ["--kind", "pair", "--seed", str(options.seed), "--cases"]
    yield ["check", *drawn, str(options.cases)], drawn_id
    yield ["check", "--axes", *drawn, str(options.axis_cases)], drawn_id
    for pattern in KEPT:
        for file in sorted(ROOT.glob(pattern)):
            yield ["check", str(file.relative_to(ROOT)), "--kind", "pair"], kept_id


def read_candidates(options):
    """The pairs of all sources with their proofs, in a fixed order, each once."""
    candidates, seen = [], set()
    for number, (command, names_of) in enumerate(sources(options)):
        proofs = options.work / f"proofs-{number}.jsonl"
        if not proofs.exists():
            touchstone(proofs.with_suffix(".log"), *command, "--save-certificates", proofs)
        with open(proofs, encoding="utf-8") as lines:
            for line in lines:
                proof = json.loads(line)
                bodies = json.dumps([proof["a"], proof["b"]])
                if proof["answer"] == "unknown" or bodies in seen:
                    continue
                seen.add(bodies)
                if len(bodies) > LONGEST_CASE or len(line) - len(bodies) > LONGEST_PROOF:
                    continue
                family, name = names_of(proof["id"])
                source = {"command": "touchstone " + " ".join(command), "id": name}
                candidates.append({"family": family, "source": source, "proof": proof})
    return candidates


# --- grades ----------------------------------------------------------------------------------------


def ask(options, candidates, first):
    """Asks all about the candidates from `first` on, and keeps the rows that are needed."""
    folder = options.work / f"grades-{first}"
    file = options.work / f"candidates-{first}.jsonl"
    done = folder / "done"
    if not done.exists():
        with open(file, "w", encoding="utf-8") as out:
            for candidate in candidates[first : first + SHARD]:
                proof = candidate["proof"]
                out.write(json.dumps({"id": proof["id"], "a": proof["a"], "b": proof["b"]}) + "\n")
        peers = [word for peer in options.peers for word in ("--peer", peer)]
        touchstone(folder.with_suffix(".log"), "check", file, "--with", "all", *peers, "--out", folder)
        done.touch()
    with open(folder / "grades.csv", newline="", encoding="utf-8") as rows:
        for row in csv.DictReader(rows):
            add_grade(candidates[first + int(row["index"])], row)


def add_grade(candidate, row):
    contestant = (row["algorithm"], row["scalar"])
    candidate.setdefault("asked", set()).add(contestant)
    candidate["expect"] = {"answer": row["exact"], **{of: bound(row["exact_" + of]) for of in ("lower", "upper")}}
    grade = row["grade"]
    if grade in NO_FAILURE:
        return
    way = row["status"] if grade == "failed" else grade
    candidate.setdefault("failures", set()).add((*contestant, row["task"], way, candidate["family"]))


def bound(text):
    """A number; JSON has no infinite ones, so these stay texts."""
    return float(text) if math.isfinite(float(text)) else text


# --- the choice ------------------------------------------------------------------------------------


def difficulty(candidate):
    failures = candidate.get("failures", set())
    return {
        "failed": len({failure[:2] for failure in failures}),
        "wrong": len({failure[:2] for failure in failures if failure[3] in WRONG}),
        "asked": len(candidate["asked"]),
    }


def told_apart(candidate):
    """The share of pairs of contestants of which one fails, of the most that there can be; a little more than 0."""
    counts = difficulty(candidate)
    share = counts["failed"] / counts["asked"]
    return 4 * share * (1 - share) + 1e-3


def choose(candidates, cap, limit):
    """Greedy cover: numbers of at most `limit` candidates, such that failures are covered up to `cap` times.

    A failure is a contestant, its scalar, the task, the way of being wrong and the family. One that is covered k times
    already adds 2^-k to what a case gains. Cases that tell contestants apart gain more. Ties go to the first.

    >>> apart = {"asked": {1, 2, 3, 4}, "failures": {("x", "double", "distance", "missed", "f")}}
    >>> all_fail = {"asked": {("x", "double")}, "failures": {("x", "double", "distance", "missed", "f")}}
    >>> other = {"asked": {1, 2, 3}, "failures": {("y", "float", "distance", "inexact", "f")}}
    >>> none = {"asked": {1, 2}}
    >>> choose([all_fail, apart, none, other], cap=1, limit=9)
    [1, 3]
    >>> choose([all_fail, apart, none, other], cap=2, limit=9)
    [0, 1, 3]
    >>> choose([all_fail, apart, none, other], cap=2, limit=1)
    [3]
    """
    covered = {}

    def gain(candidate):
        counts = (covered.get(failure, 0) for failure in candidate.get("failures", ()))
        return told_apart(candidate) * sum(2.0**-count for count in counts if count < cap)

    # Gains only shrink: a case whose gain is still what it was is the best.
    heap = [(-gain(candidate), number) for number, candidate in enumerate(candidates)]
    heapq.heapify(heap)
    chosen = []
    while heap and len(chosen) < limit:
        old, number = heapq.heappop(heap)
        now = gain(candidates[number])
        if now == 0:
            continue
        if now != -old:
            heapq.heappush(heap, (-now, number))
            continue
        chosen.append(number)
        for failure in candidates[number]["failures"]:
            covered[failure] = covered.get(failure, 0) + 1
    return sorted(chosen)


# --- the corpus ------------------------------------------------------------------------------------


def case_of(name, candidate):
    proof = candidate["proof"]
    return {
        "id": name,
        "kind": "pair",
        "family": candidate["family"],
        "expect": candidate["expect"],
        "difficulty": difficulty(candidate),
        "source": candidate["source"],
        "a": proof["a"],
        "b": proof["b"],
    }


def pack(file, objects):
    text = "".join(json.dumps(one, separators=(",", ":")) + "\n" for one in objects)
    subprocess.run(["zstd", "-19", "-q", "-o", file], input=text.encode(), check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out", type=pathlib.Path, help="a folder without a corpus, such as datasets/corpus/2027")
    parser.add_argument("--name", default="TS26", help="what ids begin with (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=2026, help="of what is drawn (default: %(default)s)")
    parser.add_argument("--cases", type=int, default=60, help="drawn of each regime (default: %(default)s)")
    parser.add_argument("--axis-cases", type=int, default=4, help="drawn of each value of an axis (default: %(default)s)")
    parser.add_argument("--peers", nargs="*", default=["mujoco", "rapier", "jolt", "cannon"], help="adapters that are asked too (default: mujoco rapier jolt cannon)")
    parser.add_argument("--cap", type=int, default=2, help="how often a failure is covered (default: %(default)s)")
    parser.add_argument("--limit", type=int, default=2000, help="most cases (default: %(default)s)")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "datasets/local/corpus", help="folder of work (default: datasets/local/corpus)")
    options = parser.parse_args()
    cases, proofs = options.out / "cases.jsonl.zst", options.out / "proofs.jsonl.zst"
    if cases.exists() or proofs.exists():
        parser.error(f"{options.out} has a corpus, which never changes; expected another folder")
    options.work = options.work.resolve()
    options.work.mkdir(parents=True, exist_ok=True)
    candidates = read_candidates(options)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda first: ask(options, candidates, first), range(0, len(candidates), SHARD)))
    candidates = [candidate for candidate in candidates if "asked" in candidate]
    chosen = [candidates[number] for number in choose(candidates, options.cap, options.limit)]
    named = [(f"{options.name}-{number:04}", candidate) for number, candidate in enumerate(chosen, 1)]
    options.out.mkdir(parents=True, exist_ok=True)
    pack(cases, [case_of(name, candidate) for name, candidate in named])
    pack(proofs, [{**candidate["proof"], "id": name} for name, candidate in named])
    print(f"{len(named)} of {len(candidates)} candidates, of {len({one['family'] for one in chosen})} families")


if __name__ == "__main__":
    main()

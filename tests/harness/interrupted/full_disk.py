#!/usr/bin/env python3
"""Runs a campaign, in one piece and in shards, on disks that are too small, each a little larger than the one
before, and goes on when there is more room: what was written stays, and the end has the rows of an undisturbed run."""

import argparse
import contextlib
import ctypes
import os
import pathlib
import subprocess
import sys
import tempfile

from interrupted import CAMPAIGN, Fault, expect, expect_same, run, run_command

SKIPPED = 77
SHARDS = 3
CLONE_NEWNS = 0x20000
PAGE = 4096


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def mount(*arguments):
    done = subprocess.run(["mount", *arguments], capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stderr.strip()


def begin_own_mounts():
    """Mounts of this process are seen by its children alone, and gone with it."""
    if os.geteuid() != 0:
        skip("mounting a small file system needs root")
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.unshare(CLONE_NEWNS) != 0:
        skip(f"no mounts of its own: {os.strerror(ctypes.get_errno())}")
    if why := mount("--make-rprivate", "/"):
        skip(why)


def whole_lines(file):
    """The bytes of a file, each line of which has its end."""
    if not file.exists():
        return b""
    content = file.read_bytes()
    expect(not content or content.endswith(b"\n"), f"half a line at the end of {file}")
    return content


def without_last_round(content):
    """What may not be measured again: all but the last round, or the last block's check."""
    lines = content.splitlines(keepends=True)
    if not lines:
        return b""
    names = lines[0].decode().strip().split(",")

    def place(line):
        fields = line.decode().split(",")
        row = dict(zip(names, fields))
        narrow = bool(row["narrow"])
        return tuple(row[name] for name in ("kind", "block", "task", "pair_kind", "square", "round")) + (
            narrow,
            row["broad"] if narrow and row["kind"] == "sample" else "",
        )

    def is_last(line):
        own, last = place(line), place(lines[-1])
        return own[:2] == last[:2] if last[0] == "check" else own == last

    kept = len(lines)
    while kept > 1 and is_last(lines[kept - 1]):
        kept -= 1
    return b"".join(lines[:kept])


class Disk:
    """A file system of a size that grows."""

    def __init__(self, folder):
        self.folder = folder
        self.size = 0
        self.full = 0  # number of times that a command found it full

    def resize(self, size):
        self.size = size
        why = mount("-o", f"remount,size={size}", str(self.folder))
        expect(not why, why)

    def expect_told(self, status, text, folder):
        """The command says that the disk is full, and where."""
        self.full += 1
        expect(status == 2, f"with {self.size} bytes: status {status}\n{text}")
        expect("No space left on device" in text, f"with {self.size} bytes the reason is not told:\n{text}")
        expect(str(folder) in text, f"with {self.size} bytes the file is not told:\n{text}")


@contextlib.contextmanager
def small_disk(folder):
    folder.mkdir()
    if why := mount("-t", "tmpfs", "-o", f"size={PAGE}", "tmpfs", str(folder)):
        skip(why)
    try:
        yield Disk(folder)
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def pages_of(folder):
    files = [file for file in folder.rglob("*") if file.is_file()]
    return sum(-(-file.stat().st_size // PAGE) for file in files) + 8


def fill(options, whole, disk):
    pages = pages_of(whole)
    out = disk.folder / "out"
    for step in range(options.steps + 1):
        disk.resize((1 + pages * step // options.steps) * PAGE)
        # Twice on the same disk: a run that cannot go on loses nothing by trying.
        for _ in range(2):
            before = whole_lines(out / "raw.csv")
            resumes = (out / "machine.csv").exists()
            status, text = run(options.program, out, *(["--resume"] if resumes else []))
            after = whole_lines(out / "raw.csv")
            expect(
                after.startswith(without_last_round(before)),
                f"with {disk.size} bytes: rows that were there are gone, {len(before)} and {len(after)} bytes",
            )
            if status == 0:
                break
            disk.expect_told(status, text, out)
        if status == 0:
            break
    expect(status == 0, f"status {status} on a disk of {disk.size} bytes\n{text}")
    expect(disk.full > 4, f"the disk was full {disk.full} times only")
    expect_same(out, whole)
    print(f"{disk.full} times the disk was full; the end has the rows of an undisturbed run")


def fill_with_shards(options, whole, disk):
    plan, merged = disk.folder / "plan", disk.folder / "merged"
    words = [("shards", "plan", CAMPAIGN, "--shards", SHARDS, "--out", plan)]
    words += [("run", "--plan", plan, "--shard", shard) for shard in range(SHARDS)]
    words += [("shards", "merge", plan, "--out", merged)]
    done = 0
    # The parts of the shards, and what is merged of them.
    pages = 3 * pages_of(whole)
    fullest = [0] * len(words)
    for step in range(3 * options.steps + 1):
        disk.resize((1 + pages * step // (3 * options.steps)) * PAGE)
        while done < len(words):
            status, text = run_command(options.program, *words[done])
            if status != 0:
                disk.expect_told(status, text, disk.folder)
                fullest[done] += 1
                break
            done += 1
    expect(done == len(words), f"status {status} on a disk of {disk.size} bytes\n{text}")
    expect(fullest[0] and any(fullest[1:-1]) and fullest[-1], f"times that the disk was full, by command: {fullest}")
    expect_same(merged, whole, of_shards=True)
    left = sorted(path.name for path in disk.folder.iterdir())
    expect(left == ["merged", "plan"], f"left behind: {left}")
    print(f"{disk.full} times the disk was full for shards; the merge has the rows of an undisturbed run")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    parser.add_argument("--steps", type=int, default=16, help="sizes of the disk, from nearly nothing to enough")
    options = parser.parse_args()
    begin_own_mounts()
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name:
        whole = pathlib.Path(name, "whole")
        status, text = run(options.program, whole)
        expect(status == 0, f"the undisturbed run: status {status}\n{text}")
        with small_disk(pathlib.Path(name, "disk")) as disk:
            fill(options, whole, disk)
        with small_disk(pathlib.Path(name, "disk-of-shards")) as disk:
            fill_with_shards(options, whole, disk)


if __name__ == "__main__":
    try:
        main()
    except Fault as fault:
        sys.exit(f"full_disk: {fault}")

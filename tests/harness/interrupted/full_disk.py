#!/usr/bin/env python3
"""Runs a campaign on disks that are too small, each a little larger than the one before, and resumes it
when there is more room: what was written stays, and the end has the rows of an undisturbed run."""

import argparse
import ctypes
import os
import pathlib
import subprocess
import sys
import tempfile

from interrupted import Fault, expect, expect_same, run

SKIPPED = 77
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


def fill(options, whole, disk):
    status, text = run(options.program, whole)
    expect(status == 0, f"the undisturbed run: status {status}\n{text}")
    files = [file for file in whole.rglob("*") if file.is_file()]
    pages = sum(-(-file.stat().st_size // PAGE) for file in files) + 8
    out = disk / "out"
    full = 0
    for step in range(options.steps + 1):
        size = (1 + pages * step // options.steps) * PAGE
        why = mount("-o", f"remount,size={size}", str(disk))
        expect(not why, why)
        # Twice on the same disk: a run that cannot go on loses nothing by trying.
        for _ in range(2):
            before = whole_lines(out / "raw.csv")
            resumes = (out / "machine.csv").exists()
            status, text = run(options.program, out, *(["--resume"] if resumes else []))
            after = whole_lines(out / "raw.csv")
            expect(
                after.startswith(without_last_round(before)),
                f"with {size} bytes: rows that were there are gone, {len(before)} and {len(after)} bytes",
            )
            if status == 0:
                break
            full += 1
            expect(status == 2, f"with {size} bytes: status {status}\n{text}")
            expect("No space left on device" in text, f"with {size} bytes the reason is not told:\n{text}")
            expect(str(out) in text, f"with {size} bytes the file is not told:\n{text}")
        if status == 0:
            break
    expect(status == 0, f"status {status} on a disk of {size} bytes\n{text}")
    expect(full > 4, f"the disk was full {full} times only")
    expect_same(out, whole)
    print(f"{full} times the disk was full; the end has the rows of an undisturbed run")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    parser.add_argument("--steps", type=int, default=16, help="sizes of the disk, from nearly nothing to enough")
    options = parser.parse_args()
    begin_own_mounts()
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name:
        disk = pathlib.Path(name, "disk")
        disk.mkdir()
        if why := mount("-t", "tmpfs", "-o", f"size={PAGE}", "tmpfs", str(disk)):
            skip(why)
        try:
            fill(options, pathlib.Path(name, "whole"), disk)
        finally:
            subprocess.run(["umount", str(disk)], check=True)


if __name__ == "__main__":
    try:
        main()
    except Fault as fault:
        sys.exit(f"full_disk: {fault}")

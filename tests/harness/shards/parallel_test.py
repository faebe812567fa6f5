#!/usr/bin/env python3
"""Does two plans by GNU parallel, on this machine and on some that a false ssh reaches, while shards and parallel
itself are killed: the merged results are those of runs that nobody disturbed."""

import argparse
import contextlib
import csv
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from shards import SHARDS, SKIPPED, Fault, campaign, expect, soak

# What parallel needs of ssh: it skips the options, takes the name of a machine and gives the rest to a shell. One of
# the machines does not answer. A machine describes itself without starting parallel four times.
SSH = """\
#!/bin/bash
while [[ $1 == -* ]]; do
  case $1 in -[lpio]) shift ;; esac
  shift
done
[[ $1 != gone ]] || exit 255
case $* in
  *"parallel --number-of-"*) echo 1; exit ;;
  *"parallel --max-line-length-allowed"*) echo 100000; exit ;;
esac
shift
if [[ $1 == -- ]]; then shift; fi
exec bash -c "$*"
"""


class Script:
    """parallel.sh of a plan, in a session of its own."""

    def __init__(self, plan, *arguments, **options):
        self.process = subprocess.Popen(
            [str(plan.folder / "parallel.sh"), *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
            **options,
        )

    def kill_parallel(self):
        """Kills parallel alone: neither the script nor the shards."""
        for process in self._members():
            try:
                words = pathlib.Path("/proc", str(process), "cmdline").read_text(errors="replace").split("\0")
            except OSError:
                continue  # it has ended meanwhile
            if any(re.fullmatch(r".*/parallel", word) for word in words[:2]):
                os.kill(process, signal.SIGKILL)

    def expect_end(self, status, text):
        said, _ = self.process.communicate(timeout=300)
        expect(self.process.returncode == status, f"parallel.sh: status {self.process.returncode}\n{said}")
        expect(text in said, f"parallel.sh does not say '{text}':\n{said}")

    def stop(self):
        for process in self._members():
            with contextlib.suppress(ProcessLookupError):  # it may have ended meanwhile
                os.kill(process, signal.SIGKILL)
        if not self.process.stdout.closed:
            print(self.process.communicate()[0], end="")

    def _members(self):
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and os.getsid(int(entry.name)) == self.process.pid:
                    found.append(int(entry.name))
            except ProcessLookupError:
                continue  # it has ended meanwhile
        return found


class Test:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.begin = time.monotonic()
        self.scripts = []

    def say(self, text):
        print(f"{time.monotonic() - self.begin:6.1f} s  {text}", flush=True)

    def start(self, plan, *arguments, **options):
        self.scripts.append(Script(plan, *arguments, **options))
        return self.scripts[-1]

    def stop(self):
        for script in self.scripts:
            script.stop()

    def on_this_machine(self, plan):
        script = self.start(plan)
        killed = plan.catch()
        killed.signal(signal.SIGKILL)
        orphan = plan.catch(lambda task: task.shard > killed.shard)
        # The system would end a process that is stopped when its parent ends.
        orphan.signal(signal.SIGCONT)
        script.kill_parallel()
        script.expect_end(2, "parallel itself failed, status 137")
        # While it goes on, nobody else can do its shard, and on a busy machine it may be slower than the next script.
        plan.wait_for_tasks()
        self.say(f"shard {killed.shard} was killed, and parallel in shard {orphan.shard}")
        last = SHARDS - 1
        with plan.lock(last):
            self.start(plan).expect_end(2, f"slurm.sh {last}\n")
        self.say(f"all shards are done but {last}, of which another process had the lock")
        self.start(plan).expect_end(0, "")
        plan.expect_same()
        twice = [shard for shard in range(SHARDS) if plan.events(shard).count("begun") > 1]
        expect(twice == [killed.shard], f"shards {twice} were begun more than once")
        self.start(plan, "3,17-19").expect_end(0, "shard 17 is done")
        self.say("the rows of an undisturbed run")

    def patient_parallel(self):
        """A folder with a copy of parallel that gives machines two minutes to describe themselves. It gives up those
        that need more than ten seconds, which happens to these where other tests run."""
        folder = self.folder / "patient"
        folder.mkdir()
        program = pathlib.Path(shutil.which("parallel")).read_text(errors="surrogateescape")
        copy = folder / "parallel"
        copy.write_text(program.replace("-j0 --timeout 10 ", "-j0 --timeout 120 "), errors="surrogateescape")
        copy.chmod(0o755)
        return folder

    def on_other_machines(self, plan):
        ssh = self.folder / "ssh"
        ssh.write_text(SSH)
        ssh.chmod(0o755)
        hosts = self.folder / "hosts"
        hosts.write_text("one\ngone\ntwo\n")
        options = ["--ssh", ssh, "--sshloginfile", hosts]
        # A service has no SHELL.
        environment = {name: value for name, value in os.environ.items() if name != "SHELL"}
        environment["PATH"] = f"{self.patient_parallel()}:{environment['PATH']}"
        script = self.start(plan, *options, env=environment)
        killed = plan.catch()
        killed.signal(signal.SIGKILL)
        script.expect_end(2, f"slurm.sh {killed.shard}\n")
        self.say(f"shard {killed.shard} was killed, and a machine does not answer")
        self.start(plan, *options, env=environment).expect_end(0, "")
        plan.expect_same()
        with open(plan.folder / "parallel.joblog", newline="") as file:
            jobs = [(row["Host"], float(row["Starttime"]), float(row["JobRuntime"])) for row in csv.DictReader(file, delimiter="\t")]
        expect({host for host, _, _ in jobs} == {"one", "two"}, f"parallel's log: {jobs}")
        for host in ("one", "two"):
            own = sorted((begin, begin + length) for name, begin, length in jobs if name == host)
            both = [(a, b) for a, b in zip(own, own[1:]) if b[0] < a[1] - 0.1]
            expect(not both, f"two shards at once on machine {host}: {both}")
        self.say("two machines; the rows of an undisturbed run")

    def without_parallel(self, plan):
        """The script names what is missing."""
        tools = self.folder / "tools"
        tools.mkdir()
        for tool in ("env", "bash", "dirname", "readlink"):
            (tools / tool).symlink_to(shutil.which(tool))
        self.start(plan, env={"PATH": str(tools)}).expect_end(2, "GNU parallel is not installed")

    def run(self):
        plans = campaign(self.program, self.folder), soak(self.program, self.folder)
        for plan in plans:
            plan.run_undisturbed()
        self.say("two plans, and a run of each that nobody disturbs")
        self.without_parallel(plans[0])
        self.on_this_machine(plans[0])
        self.on_other_machines(plans[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    options = parser.parse_args()
    if shutil.which("parallel") is None:
        print("skipped: GNU parallel is not installed; Debian: parallel")
        sys.exit(SKIPPED)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("parallel_test: was told to stop"))
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name:
        test = Test(os.path.abspath(options.program), pathlib.Path(name))
        try:
            test.run()
        finally:
            test.stop()


if __name__ == "__main__":
    try:
        main()
    except Fault as fault:
        sys.exit(f"parallel_test: {fault}")

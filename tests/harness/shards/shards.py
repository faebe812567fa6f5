"""What the tests beside this file share: plans, the processes that do their shards, and comparing the results."""

import contextlib
import csv
import fcntl
import os
import pathlib
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "interrupted"))

from interrupted import Fault, expect, expect_same  # noqa: E402

__all__ = ["HERE", "Fault", "Plan", "SHARDS", "SKIPPED", "Task", "campaign", "expect", "measured", "soak"]

SHARDS = 20
SKIPPED = 77
# What a soak's rows tell does not depend on the machine, so every column counts.
NOT_OF_A_SOAK = ()


def measured(*words, wrong_is_fine=False):
    """Seconds and megabytes of a command. Its status may tell that something measured is wrong."""
    begin = time.monotonic()
    with subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in ((0, 1) if wrong_is_fine else (0,)):
        sys.exit(f"{' '.join(map(str, words))} ended with status {process.returncode}")
    return time.monotonic() - begin, usage.ru_maxrss / 1024


class Task:
    """A process that does a shard."""

    def __init__(self, plan, shard, process):
        self.plan, self.shard, self.process = plan, shard, process
        text = pathlib.Path("/proc", str(process), "environ").read_bytes().decode()
        if not text:
            raise ProcessLookupError(f"process {process} is about to run another program")
        self.environment = dict(line.partition("=")[::2] for line in text.split("\0"))

    @property
    def node(self):
        return self.environment["SLURMD_NODENAME"]

    @property
    def job(self):
        return self.environment["SLURM_ARRAY_JOB_ID"] + "_" + self.environment["SLURM_ARRAY_TASK_ID"]

    def signal(self, number):
        os.kill(self.process, number)

    def hold(self):
        """Stops the process. False if it was about to end, or not in its work yet."""

        def works():
            attempts = self.plan.attempts(self.shard)
            return attempts and attempts[-1]["event"] == "begun" and attempts[-1]["process"] == str(self.process)

        try:
            if not works():
                return False
            self.signal(signal.SIGSTOP)
            if works():
                return True
            self.signal(signal.SIGCONT)
        except ProcessLookupError:
            pass
        return False


class Plan:
    """A plan in a folder, and the results of a run of the same file that nobody disturbs."""

    def __init__(self, program, file, folder, flags, compare):
        self.program, self.file, self.folder, self.compare = program, file, pathlib.Path(folder), compare
        self.whole = self.folder.with_name(self.folder.name + "-whole")
        self.results = self.folder / "results"
        self.touchstone("shards", "plan", file, "--shards", SHARDS, "--out", self.folder, *flags)
        for script in ("slurm.sh", "parallel.sh"):
            own = (HERE.parents[2] / "harness/shards" / script).read_bytes()
            expect((self.folder / script).read_bytes() == own, f"{script} of the plan is another than the project's")
            expect(os.access(self.folder / script, os.X_OK), f"{script} of the plan cannot be executed")

    def touchstone(self, *arguments, status=0):
        command = [str(argument) for argument in (self.program, *arguments)]
        ran = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        expect(ran.returncode == status, f"{' '.join(command)}: status {ran.returncode}\n{ran.stdout}")
        return ran.stdout

    def run_undisturbed(self):
        self.touchstone("run", self.file, "--out", self.whole)

    def folder_of(self, shard):
        return self.folder / "shards" / str(shard // 1000) / str(shard)

    def has_rows(self, shard):
        """Whether the work of a shard has begun, and not only the process that does it."""
        return any(self.folder_of(shard).glob("part-*"))

    def attempts(self, shard):
        """The rows of attempts.csv, without one that is being written."""
        file = self.folder_of(shard) / "attempts.csv"
        text = file.read_text() if file.exists() else ""
        return list(csv.DictReader(text[: text.rfind("\n") + 1].splitlines()))

    def events(self, shard):
        return [row["event"] for row in self.attempts(shard)]

    @contextlib.contextmanager
    def lock(self, shard):
        """Holds a shard as another process does that works on it."""
        self.folder_of(shard).mkdir(parents=True, exist_ok=True)
        with open(self.folder_of(shard) / "lock", "a") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield

    def tasks(self):
        """The processes that do shards of this plan, without their workers."""
        found = {}
        for entry in os.listdir("/proc"):
            if entry.isdigit() and (shard := self._shard_of(entry)) is not None:
                try:
                    stat = pathlib.Path("/proc", entry, "stat").read_text(errors="replace")
                    found[entry] = Task(self, shard, int(entry)), stat.rpartition(")")[2].split()[1]
                except OSError:
                    continue  # it has ended meanwhile
        return [task for task, parent in found.values() if parent not in found]

    def catch(self, fits=lambda task: True, seconds=60.0):
        """Waits for a process in the middle of a shard, and holds it."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for task in self.tasks():
                if fits(task) and task.hold():
                    return task
            time.sleep(0.01)
        raise Fault(f"no shard of {self.folder} was caught in {seconds:g} s\n{self.touchstone('shards', 'status', self.folder)}")

    def wait_for_tasks(self, seconds=120.0):
        """Waits until no process does a shard of this plan."""
        end = time.monotonic() + seconds
        while tasks := self.tasks():
            expect(time.monotonic() < end, f"shards {[task.shard for task in tasks]} are not done in {seconds:g} s")
            time.sleep(0.01)

    def expect_same(self):
        """The results have the rows of the undisturbed run: none is lost, none is there twice."""
        self.compare(self.results, self.whole)
        with open(self.results / "shards.csv", newline="") as file:
            done = [int(row["shard"]) for row in csv.DictReader(file)]
        expect(done == list(range(SHARDS)), f"shards.csv has the shards {done}")
        leftovers = [path.name for path in self.folder.iterdir() if "merging" in path.name]
        expect(not leftovers, f"a merge left {leftovers}")

    def _shard_of(self, process):
        try:
            words = pathlib.Path("/proc", process, "cmdline").read_bytes().decode(errors="replace").split("\0")
        except OSError:
            return None
        words = [word for word in words if not word.startswith("--of-build=")]  # of one program for the other
        marks = ["run", "--plan", str(self.folder), "--shard"]
        return int(words[5]) if words[1:5] == marks else None


def rows_of(file, leave_out):
    with open(file, newline="") as opened:
        rows = csv.DictReader(opened)
        return [{name: value for name, value in row.items() if name not in leave_out} for row in rows]


def expect_same_rows(own, expected, file):
    expect(len(own) == len(expected), f"{file}: {len(own)} rows; expected {len(expected)}")
    for place, (row, other) in enumerate(zip(own, expected)):
        expect(row == other, f"{file}, row {place}: {row}; expected {other}")


def compare_soaks(results, whole):
    for file in ("jobs.csv", "soak.csv"):
        expect_same_rows(rows_of(results / file, NOT_OF_A_SOAK), rows_of(whole / file, NOT_OF_A_SOAK), file)


def compare_campaigns(results, whole):
    expect_same(results, whole, of_shards=True)


def soak(program, folder, *flags, file=HERE / "soak.toml"):
    return Plan(program, file, pathlib.Path(folder, "soak"), flags, compare_soaks)


def campaign(program, folder, *flags):
    return Plan(program, HERE / "campaign.toml", pathlib.Path(folder, "campaign"), flags, compare_campaigns)

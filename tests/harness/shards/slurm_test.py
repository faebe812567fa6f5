#!/usr/bin/env python3
"""Does two plans on a Slurm cluster while nodes, tasks and the controller are killed, then what is missing, by the
commands that the program names: the merged results are those of runs that nobody disturbed."""

import argparse
import contextlib
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from cluster import Cluster, ClusterError, Skip, wait_until
from shards import HERE, SHARDS, SKIPPED, Fault, campaign, expect, soak

# A plan of 20 shards needs three arrays of that many tasks.
MOST_OF_AN_ARRAY = 8

# An `sbatch` that refuses every array but the first, as a cluster that is full does.
REFUSING = """\
#!/bin/sh
case "$*" in
  *\\ 0) exec {sbatch} "$@" ;;
esac
echo "sbatch: error: Batch job submission failed: the queue is full" >&2
exit 1
"""


class Test:
    def __init__(self, cluster, program, folder):
        self.cluster, self.folder = cluster, folder
        self.begin = time.monotonic()
        self.program = program

    def say(self, text):
        print(f"{time.monotonic() - self.begin:6.1f} s  {text}", flush=True)

    def submit(self, plan, *arguments):
        done = self.cluster.run(plan.folder / "slurm.sh", *arguments)
        self.say(f"{plan.folder.name}: {done.stdout.splitlines()[0]}")

    def submit_to_full_cluster(self, plan):
        """What Slurm refuses is named, with the command that submits it later."""
        shims = self.folder / "shims"
        shims.mkdir()
        (shims / "sbatch").write_text(REFUSING.format(sbatch=shutil.which("sbatch")))
        (shims / "sbatch").chmod(0o755)
        path = {"PATH": f"{shims}:{os.environ['PATH']}"}
        script = plan.folder / "slurm.sh"
        done = self.cluster.run(script, "--comment=a b", check=False, env=self.cluster.environment | path)
        expect(done.returncode == 1, f"status {done.returncode}\n{done.stdout}{done.stderr}")
        command = f"{script} 8-15,16-19 --comment=a\\ b"
        expect(command in done.stderr, f"the command that submits the rest is not told:\n{done.stderr}")
        self.cluster.run("bash", "-c", command)
        self.say(f"{plan.folder.name}: shards that were refused are submitted")

    def disturb(self, plan):
        """Ends tasks in all ways in which they end on a cluster. Returns the shards that were killed, and the one that
        was told to end."""
        kept = plan.catch(lambda task: task.node == "n2")
        self.cluster.kill_daemon("n2")
        self.cluster.start_node("n2")
        self.cluster.wait_for_nodes(["n2"])
        kept.signal(signal.SIGCONT)
        self.say(f"{plan.folder.name}: the daemon of node n2 was killed, and started; shard {kept.shard} goes on")
        lost = plan.catch(lambda task: task.node == "n1")
        self.cluster.kill_node("n1")
        self.cluster.say_that_node_is_down("n1")
        self.cluster.start_node("n1")
        self.say(f"{plan.folder.name}: node n1 was killed with shard {lost.shard}, and started")
        requeued = plan.catch(lambda task: task.shard not in (kept.shard, lost.shard))
        self.cluster.run("scontrol", "requeue", requeued.job)
        # Without the signal it may end before Slurm ends it, and is not begun again.
        wait_until(lambda: is_told_to_end(requeued.process), 30, "the end of what was put back")
        with contextlib.suppress(ProcessLookupError):
            requeued.signal(signal.SIGCONT)
        self.say(f"{plan.folder.name}: shard {requeued.shard} was put back into the queue")
        killed = plan.catch(lambda task: task.shard not in (kept.shard, lost.shard, requeued.shard))
        killed.signal(signal.SIGKILL)
        self.say(f"{plan.folder.name}: shard {killed.shard} was killed")
        return {lost.shard, killed.shard}, requeued.shard

    def tell_to_stop(self, plan):
        """A signal to the batch script reaches the program, which stops where nothing is lost."""

        def told():
            # Slurm refuses it while it alters the job itself. A controller that was killed may have forgotten what it
            # started: it starts it again, is refused, and holds the job, until an operator lets it go on.
            self.cluster.repair()
            task = plan.catch(lambda task: plan.has_rows(task.shard))
            try:
                done = self.cluster.run("scancel", "--batch", "--signal=TERM", task.job, check=False, timeout=5)
                if done.returncode == 0:
                    return task
            except subprocess.TimeoutExpired:
                # It tries again for a minute and more, while the job waits for the task that is held.
                with contextlib.suppress(FileNotFoundError):
                    if pending(task.process, signal.SIGTERM):
                        return task
            with contextlib.suppress(ProcessLookupError):
                task.signal(signal.SIGCONT)
            return None

        self.expect_told(plan, wait_until(told, 180, "a task that can be told to stop"), 10)

    def expect_told(self, plan, told, seconds):
        wait_until(lambda: pending(told.process, signal.SIGTERM), seconds, "the signal in the program")
        told.signal(signal.SIGCONT)
        wait_until(lambda: plan.events(told.shard)[-1] != "begun", 30, "the end of what was told to end")
        events = plan.events(told.shard)
        expect(events[-1] in ("interrupted", "done"), f"shard {told.shard}: {events}")
        self.say(f"{plan.folder.name}: shard {told.shard} was told to stop: {events[-1]}")

    def complete(self, plan, most=3):
        """Runs the commands that merges print, until a job has joined all shards. Returns how many it took."""
        commands = 0
        while not (plan.results / "machine.csv").exists():
            text = plan.touchstone("shards", "merge", plan.folder, "--out", plan.results, status=2)
            command = re.search(r"to run them: (.*)", text)
            expect(command and commands < most, f"after {commands} commands:\n{text}")
            commands += 1
            self.say(f"{plan.folder.name}: {command[1]}")
            self.cluster.run("bash", "-c", command[1])
            self.cluster.wait_for_jobs(120)
        plan.expect_same()
        return commands

    def run(self):
        # Tasks of the soak share nodes, and each of the campaign has one for itself.
        plans = soak(self.program, self.folder, "--cpus", "1"), campaign(self.program, self.folder)
        for plan in plans:
            plan.run_undisturbed()
        self.say("two plans, and a run of each that nobody disturbs")
        self.submit(plans[0])
        self.submit_to_full_cluster(plans[1])
        killed, told = self.disturb(plans[0])
        self.cluster.wait_until_saved()
        self.cluster.restart_controller()
        self.say("the controller was killed and started")
        self.tell_to_stop(plans[1])
        self.cluster.wait_for_jobs(150)
        self.say("all jobs have ended")
        commands = [self.complete(plan) for plan in plans]
        expect(commands[0] > 0, "the shard that was killed was not missing")
        # Only what was told to end may have been done by then.
        again = {shard for shard in killed | {told} if len(plans[0].events(shard)) < 3}
        if plans[0].events(told)[-1] == "done":
            again.discard(told)
        expect(not again, f"shards {again} were ended, and not begun again")
        attempts = sum(plan.events(shard).count("begun") for plan in plans for shard in range(SHARDS))
        self.say(f"{2 * SHARDS} shards, {attempts} attempts: the rows of undisturbed runs")


class LongTest(Test):
    """Disturbs larger plans at random, with kills that Slurm has to notice by itself, and reaches time limits."""

    def __init__(self, cluster, program, folder, seed):
        super().__init__(cluster, program, folder)
        self.draw = random.Random(seed)

    def random_task(self, plans):
        tasks = [task for plan in plans for task in plan.tasks() if "SLURMD_NODENAME" in task.environment]
        return self.draw.choice(tasks) if tasks else None

    def disturb_once(self, plans):
        task, node = self.random_task(plans), self.draw.choice(("n1", "n2"))
        kind = self.draw.choice(("power", "power", "daemon", "controller", "kill", "requeue", "cancel", "stop"))
        if kind == "power":
            self.cluster.kill_node(node)
            time.sleep(self.draw.uniform(0, 25))
            self.cluster.start_node(node)
        elif kind == "daemon":
            self.cluster.kill_daemon(node)
            self.cluster.start_node(node)
        elif kind == "controller":
            self.cluster.restart_controller()
        elif task is None:
            return
        elif kind == "kill":
            with contextlib.suppress(ProcessLookupError):
                task.signal(signal.SIGKILL)
        else:
            commands = {"requeue": ["scontrol", "requeue"], "cancel": ["scancel"], "stop": ["scancel", "-b", "-s", "TERM"]}
            self.cluster.run(*commands[kind], task.job, check=False)
        self.say(f"{kind} {node if kind in ('power', 'daemon') else ''}{task.job if task else ''}")

    def reach_limits(self, plan):
        """Slurm's early signal reaches a task, and a task that does not hear it is killed at the limit."""
        for shard, minutes in ((5, 1), (6, 2)):
            self.cluster.run(plan.folder / "slurm.sh", str(shard), f"--time={minutes}")
        deaf = plan.catch(lambda task: task.shard == 5)
        told = plan.catch(lambda task: task.shard == 6 and plan.has_rows(6))
        self.expect_told(plan, told, 150)
        wait_until(lambda: (deaf.job, "TIMEOUT") in self.cluster.jobs(), 150, "the time limit")
        expect(plan.events(5) == ["begun"], f"shard 5: {plan.events(5)}")
        self.say(f"{plan.folder.name}: shard 5 was killed at its time limit")

    def run(self):
        large = self.folder / "large.toml"
        large.write_text((HERE / "soak.toml").read_text().replace("40_000", "600_000"))
        plans = soak(self.program, self.folder, "--cpus", "1", file=large), campaign(self.program, self.folder)
        for plan in plans:
            plan.run_undisturbed()
        self.say("two plans, and a run of each that nobody disturbs")
        self.reach_limits(plans[0])
        for plan in plans:
            self.submit(plan)
        end = time.monotonic() + 300
        while time.monotonic() < end and self.cluster.goes_on():
            time.sleep(self.draw.uniform(0, 6))
            self.disturb_once(plans)
            self.cluster.repair()
        self.cluster.wait_for_jobs(300)
        for plan in plans:
            self.complete(plan)
        attempts = sum(plan.events(shard).count("begun") for plan in plans for shard in range(SHARDS))
        self.say(f"{2 * SHARDS} shards, {attempts} attempts: the rows of undisturbed runs")


def is_told_to_end(process):
    """Whether a process that was held has ended, was let go on by the scheduler, or has a signal to end."""
    try:
        status = pathlib.Path("/proc", str(process), "status").read_text()
        return not re.search(r"^State:\s+[Tt]", status, re.MULTILINE) or pending(process, signal.SIGTERM)
    except (FileNotFoundError, ProcessLookupError):
        return True


def pending(process, number):
    """Whether a signal waits for a process that is held."""
    for line in pathlib.Path("/proc", str(process), "status").read_text().splitlines():
        if line.startswith(("SigPnd:", "ShdPnd:")) and int(line.split()[1], 16) >> (number - 1) & 1:
            return True
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the built touchstone")
    parser.add_argument("--long", action="store_true", help="ten minutes of random disturbances, and time limits")
    parser.add_argument("--seed", type=int, default=1, help="of the random disturbances")
    options = parser.parse_args()
    # An end by SIGTERM takes the cluster down too.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("slurm_test: was told to stop"))
    with tempfile.TemporaryDirectory(prefix="touchstone-") as name:
        folder = pathlib.Path(name)
        with Cluster(folder / "cluster", most_of_an_array=MOST_OF_AN_ARRAY) as cluster:
            try:
                words = cluster, os.path.abspath(options.program), folder
                (LongTest(*words, options.seed) if options.long else Test(*words)).run()
            except (Fault, ClusterError):
                print(cluster.report())
                raise


if __name__ == "__main__":
    try:
        main()
    except Skip as why:
        print(f"skipped: {why}")
        sys.exit(SKIPPED)
    except (Fault, ClusterError) as fault:
        sys.exit(f"slurm_test: {fault}")

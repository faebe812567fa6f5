"""A Slurm cluster of two nodes on this machine, for as long as a test needs it.

Everything is in one folder: keys, ports, logs and the state. The daemons are children of this process, which
also adopts what they leave behind, so that `stop` ends exactly the processes that were started here."""

import contextlib
import ctypes
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = {
    "munged": "munge",
    "slurmctld": "slurm-wlm",
    "slurmd": "slurm-wlm",
    "sbatch": "slurm-client",
    "scontrol": "slurm-client",
    "squeue": "slurm-client",
    "scancel": "slurm-client",
}
PR_SET_PDEATHSIG = 1
PR_SET_CHILD_SUBREAPER = 36
LIBC = ctypes.CDLL(None, use_errno=True)

# Waits are short: a dead node is noticed after seconds, and a task that was put back into the queue waits for as
# long as a credential lives.
CONFIGURATION = """\
ClusterName=touchstone
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/affinity
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,sched_min_interval=100000,bf_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
SlurmdTimeout=5
SlurmctldTimeout=5
MessageTimeout=5
KillWait=5
InactiveLimit=0
ReturnToService=2
MaxArraySize={most_of_an_array}
{more}
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class Skip(Exception):
    """A reason for which there can be no cluster here."""


class ClusterError(Exception):
    """The cluster does not do what it should."""


def wait_until(holds, seconds, what, interval=0.05):
    """Returns what `holds` returns, as soon as that is true."""
    end = time.monotonic() + seconds
    while not (value := holds()):
        if time.monotonic() > end:
            raise ClusterError(f"waited {seconds:g} s for {what}")
        time.sleep(interval)
    return value


def adopt_orphans():
    """Processes whose parents end become children of this one, and not of the system's first process."""
    if LIBC.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise Skip("the processes of a cluster could not be followed: there is no PR_SET_CHILD_SUBREAPER")


def end_with_parent():
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)


def descendants():
    """The processes that this one started, directly or not, and that have not ended."""
    children = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            with contextlib.suppress(OSError):  # it has ended meanwhile
                stat = pathlib.Path("/proc", entry, "stat").read_text(errors="replace")
                state, parent = stat.rpartition(")")[2].split()[:2]
                if state not in "ZX":
                    children.setdefault(int(parent), []).append(int(entry))
    found, left = [], [os.getpid()]
    while left:
        more = children.get(left.pop(), [])
        found += more
        left += more
    return found


def environment_of(process):
    try:
        text = pathlib.Path("/proc", str(process), "environ").read_bytes()
    except OSError:
        return set()
    return set(text.decode(errors="replace").split("\0"))


def kill(processes):
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


def free_ports(count):
    with contextlib.ExitStack() as stack:
        ports = []
        for _ in range(count):
            taken = stack.enter_context(socket.socket())
            taken.bind(("127.0.0.1", 0))
            ports.append(taken.getsockname()[1])
        return ports


class Cluster:
    """`with Cluster(folder) as cluster:` brings it up and takes it down."""

    def __init__(self, folder, nodes=("n1", "n2"), most_of_an_array=1001, more=""):
        if os.geteuid() != 0:
            raise Skip("Slurm's daemons start the jobs of all users, which needs root")
        path = os.environ["PATH"] + ":/usr/sbin"
        missing = {package for program, package in PROGRAMS.items() if shutil.which(program, path=path) is None}
        if missing:
            raise Skip("Slurm is not installed; Debian: " + " ".join(sorted(missing)))
        adopt_orphans()
        self.folder = pathlib.Path(folder)
        self.nodes = nodes
        self.daemons = {}
        self.environment = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM", "SBATCH"))}
        self.environment["PATH"] = path
        self.environment["SLURM_CONF"] = str(self.folder / "slurm.conf")
        self.most_of_an_array = most_of_an_array
        self.more = more

    def __enter__(self):
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def start(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        self.folder.chmod(0o755)  # munged refuses a socket in a folder that others cannot enter
        (self.folder / "state").mkdir(exist_ok=True)
        self._configure()
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        files = {"key-file": key, "socket": self.folder / "munge.socket", "pid-file": self.folder / "munged.pid"}
        files |= {"log-file": self.folder / "munged.log", "seed-file": self.folder / "munged.seed"}
        self._spawn("munged", "munged", "--foreground", "--force", *(f"--{k}={v}" for k, v in files.items()))
        wait_until(files["socket"].exists, 20, "munged")
        self._spawn("slurmctld", "slurmctld", "-D", "-c")
        for node in self.nodes:
            self.start_node(node)
        self.wait_for_nodes(self.nodes)

    def stop(self):
        """Ends what was started, in whatever state it is."""
        for daemon in self.daemons.values():
            daemon.terminate()
        end = time.monotonic() + 3
        for daemon in self.daemons.values():
            with contextlib.suppress(subprocess.TimeoutExpired):
                daemon.wait(max(0, end - time.monotonic()))
        # What is killed may leave children, so one look is not enough.
        while left := self.processes():
            kill(left)
            time.sleep(0.02)
        for daemon in self.daemons.values():
            daemon.wait()
        self.daemons = {}

    def processes(self):
        """The processes of the cluster and of its jobs."""
        mark = f"SLURM_CONF={self.environment['SLURM_CONF']}"
        return [process for process in descendants() if mark in environment_of(process)]

    def start_node(self, node):
        self._spawn(node, "slurmd", "-D", "-N", node)

    def kill_daemon(self, name):
        """Kills the daemon of a node alone, or another; the tasks of a node go on."""
        daemon = self.daemons.pop(name)
        daemon.kill()
        daemon.wait()

    def kill_node(self, node):
        """Kills the daemon of a node and its tasks, as if the machine had lost its power. The controller notices that
        after a quarter of a minute, when it puts the tasks back into the queue."""
        self.kill_daemon(node)
        while left := self._processes_of(node):
            kill(left)
            time.sleep(0.02)

    def say_that_node_is_down(self, node):
        """What an operator does, or a check of the nodes' health, so that the controller knows at once."""
        self.run("scontrol", "update", f"NodeName={node}", "State=DOWN", "Reason=killed")

    def restart_controller(self):
        """Kills the controller and starts another, which goes on with what was saved."""
        self.kill_daemon("slurmctld")
        self._spawn("slurmctld", "slurmctld", "-D")
        wait_until(lambda: self.run("scontrol", "ping", check=False).returncode == 0, 30, "the controller")

    def repair(self):
        """What an operator does after failures: nodes that Slurm has put aside come back, and held jobs may run."""
        listed = self.run("sinfo", "--noheader", "--Node", "--format=%N %T", check=False).stdout
        for node, state in (line.split() for line in listed.splitlines()):
            if state.startswith("drain"):
                self.run("scontrol", "update", f"NodeName={node}", "State=RESUME", check=False)
        listed = self.run("squeue", "--noheader", "--array", "--states=PENDING", "--format=%i %r", check=False).stdout
        for job, reason in (line.split(maxsplit=1) for line in listed.splitlines()):
            if "held" in reason.lower():
                self.run("scontrol", "release", job, check=False)

    def wait_until_saved(self):
        """Waits until the controller has saved what it knows, which it does every five seconds if there is news. A
        controller that is killed before forgets jobs, even if it has told their numbers."""
        now = time.time()
        saved = self.folder / "state" / "job_state"
        wait_until(lambda: saved.exists() and saved.stat().st_mtime > now, 30, "the controller's state on the disk")

    def run(self, *command, check=True, **options):
        """Runs a command that talks to this cluster. With `check`, it may not fail."""
        options = {"env": self.environment, "text": True, "capture_output": True} | options
        done = subprocess.run(command, check=False, **options)
        if check and done.returncode != 0:
            raise ClusterError(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout}{done.stderr}")
        return done

    def jobs(self):
        """What is in the queue: pairs of names such as 12_3 and states such as RUNNING."""
        listed = self.run("squeue", "--noheader", "--array", "--states=all", "--format=%i %T", check=False)
        return [tuple(line.split()) for line in listed.stdout.splitlines()] if listed.returncode == 0 else None

    def goes_on(self):
        """Whether a job waits or runs, or the controller does not answer."""
        jobs = self.jobs()
        going_on = ("PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "REQUEUED", "SUSPENDED")
        return jobs is None or any(state in going_on for _, state in jobs)

    def wait_for_jobs(self, seconds):
        def ended():
            self.repair()
            return not self.goes_on()

        wait_until(ended, seconds, "the end of all jobs", interval=0.2)

    def wait_for_nodes(self, nodes):
        def are_up():
            listed = self.run("sinfo", "--noheader", "--Node", "--format=%N %T", check=False).stdout.splitlines()
            states = dict(line.split() for line in listed)
            return all(states.get(node) in ("idle", "allocated", "mixed", "completing") for node in nodes)

        wait_until(are_up, 30, f"the nodes {' '.join(nodes)}; their logs are in {self.folder}")

    def report(self):
        """What there is to see when something went wrong."""
        commands = (["sinfo", "--Node", "--long"], ["squeue", "--states=all", "--format=%i %T %r %N"])
        texts = [self.run(*command, check=False).stdout for command in commands]
        for log in sorted(self.folder.glob("slurm*.log")):
            texts.append(f"{log.name}\n" + "".join(log.read_text(errors="replace").splitlines(keepends=True)[-40:]))
        return "\n".join(texts)

    def _configure(self):
        host = socket.gethostname().partition(".")[0]
        controller_port, *ports = free_ports(1 + len(self.nodes))
        lines = [
            f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={os.cpu_count()} State=UNKNOWN"
            for node, port in zip(self.nodes, ports)
        ]
        values = {"host": host, "folder": self.folder, "controller_port": controller_port, "more": self.more}
        values |= {"nodes": "\n".join(lines), "most_of_an_array": self.most_of_an_array}
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(**values))

    def _spawn(self, name, *command):
        with open(self.folder / f"{name}.out", "a") as output:
            self.daemons[name] = subprocess.Popen(
                command,
                env=self.environment | {"TOUCHSTONE_NODE": name},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                preexec_fn=end_with_parent,
                start_new_session=True,
            )

    def _processes_of(self, node):
        marks = {f"TOUCHSTONE_NODE={node}", f"SLURMD_NODENAME={node}"}
        return [process for process in self.processes() if marks & environment_of(process)]

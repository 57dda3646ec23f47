"""protocols/examples/cluster/simulate.sh on a real Slurm of one node, which this test starts and stops:
one task of the array is requeued while it runs, one is killed and its array submitted again, and the
merged log is that of one run, row for row. Skipped (exit code 77) where Slurm is not installed.

Run as root: python3 tests/studies/simulation_on_slurm.py PATH_TO_HEFT [-v]
"""
import os
import re
import shutil
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "protocols/examples/cluster/simulate.sh"
SKIPPED = 77
PARTICIPANTS, SHARDS = 60, 4
CONF = """ClusterName=heft
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser=root
SlurmdUser=root
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobRequeue=1
MpiDefault=none
MailProg=/bin/true
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
KillWait=5
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory_mb} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES State=UP
"""


def why_not():
    for program in ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "scancel"):
        if not shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin:/sbin"):
            return f"{program} is not installed (Debian: slurmctld slurmd slurm-client munge)"
    return None if os.geteuid() == 0 else "slurmd needs root"


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def until(condition, seconds=120):
    end = time.monotonic() + seconds
    while not (found := condition()):
        if time.monotonic() > end:
            raise TimeoutError("waited in vain")
        time.sleep(0.05)
    return found


def n_sessions(db):
    try:
        with sqlite3.connect(f"file:{db}?mode=ro", uri=True) as log:
            return log.execute("select count(*) from session").fetchone()[0]
    except sqlite3.Error:  # it is being made
        return 0


class OnSlurm(unittest.TestCase):
    heft = None

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="heft-slurm-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.environment = os.environ | {
            "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin", "SLURM_CONF": f"{self.folder}/slurm.conf",
            "HEFT": self.heft, "PARTICIPANTS": str(PARTICIPANTS), "SHARDS": str(SHARDS), "SEED": "3",
            "FOLDER": f"{self.folder}/simulation", "PROTOCOL": f"{ROOT}/protocols/jnd.toml"}
        self.start_slurm()

    def start_slurm(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        (self.folder / "slurm.conf").write_text(CONF.format(
            host=socket.gethostname(), controller_port=free_port(), node_port=free_port(),
            folder=self.folder, cpus=os.cpu_count(),
            memory_mb=os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20 * 9 // 10))
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.daemon("munged", "-F", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                    f"--pid-file={self.folder}/munge.pid", f"--log-file={self.folder}/munge.log",
                    f"--seed-file={self.folder}/munge.seed")
        until((self.folder / "munge.socket").exists)
        self.daemon("slurmctld", "-c", "-D")
        self.daemon("slurmd", "-D")
        until(lambda: "idle" in self.slurm("sinfo", "-h", expect=None))

    def daemon(self, *words):
        out = open(self.folder / f"{words[0]}.out", "w")
        process = subprocess.Popen(words, stdout=out, stderr=out, env=self.environment)

        def stop():
            process.terminate()
            try:
                process.wait(15)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            out.close()
        self.addCleanup(stop)

    def slurm(self, *words, expect=0):
        done = subprocess.run(words, capture_output=True, text=True, timeout=60, env=self.environment)
        if expect is not None:
            self.assertEqual(done.returncode, expect, f"{words}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def submit(self):
        return re.match(r"array (\d+), merge (\d+)", self.slurm("bash", SCRIPT)).groups()

    def shard(self, number):
        return self.folder / f"simulation/shard-{number}.db"

    def await_sessions(self, number):
        """Until the shard's task has stored someone, and is not complete."""
        until(lambda: n_sessions(self.shard(number)) > 0)
        self.assertLess(n_sessions(self.shard(number)), PARTICIPANTS // SHARDS)

    def await_end(self):
        until(lambda: not self.slurm("squeue", "-h").strip(), 600)

    def check_against_one_run(self):
        merged, one = self.folder / "simulation/all.db", self.folder / "one.db"
        subprocess.run([self.heft, "simulate", self.environment["PROTOCOL"], "--seed", "3", "--participants",
                        str(PARTICIPANTS), "--db", one], check=True, capture_output=True, timeout=600)
        rows = [list(sqlite3.connect(db).iterdump()) for db in (merged, one)]
        self.assertTrue(rows[0] == rows[1])

    def test_a_requeued_and_a_killed_task_change_nothing(self):
        array, _ = self.submit()
        self.await_sessions(1)
        self.slurm("scontrol", "requeue", f"{array}_1")
        until(lambda: "BeginTime" in self.slurm("squeue", "-h", "-r"))
        n_before = n_sessions(self.shard(1))
        self.slurm("scontrol", "update", f"JobId={array}_1", "StartTime=now")  # it waits for 2 min
        self.await_sessions(3)
        self.slurm("scancel", "--signal=KILL", "--full", f"{array}_3")
        self.await_end()
        self.assertFalse((self.folder / "simulation/all.db").exists())
        self.assertLess(n_sessions(self.shard(3)), PARTICIPANTS // SHARDS)
        self.assertIn(f"{n_before} of them in", (self.folder / "simulation/shard-1.txt").read_text())

        self.submit()
        self.await_end()
        self.assertIn(f"{PARTICIPANTS} participants in", (self.folder / "simulation/merge.txt").read_text())
        self.check_against_one_run()


if __name__ == "__main__":
    OnSlurm.heft = os.path.abspath(sys.argv.pop(1))
    if reason := why_not():
        print(f"skipped: {reason}")
        sys.exit(SKIPPED)
    unittest.main()

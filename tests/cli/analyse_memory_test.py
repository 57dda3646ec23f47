"""heft analyse reads one session at a time: what it keeps of each participant is small.

Run: python3 tests/cli/analyse_memory_test.py PATH_TO_HEFT
"""
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROTOCOL = Path(__file__).resolve().parents[2] / "protocols" / "examples" / "paired_staircases.toml"
# For each participant: 65 were measured, of which about 33 are the nodes over which the mixed model
# integrates.
MOST_KB = 72
IDS = ("session_id", "trial_id", "event_id", "setup_id", "answer_id", "from_event_id", "frame_id")
TABLES = ("session", "participant_info", "event", "setup", "participant_parameter", "trial", "cube",
          "answer", "reversal", "estimate")
heft = None


def copy_sessions(log, n_copies):
    """Adds n_copies of each session, with other ids and participants; their digests are wrong."""
    db = sqlite3.connect(log)
    apart = 1 + max(db.execute("select ifnull(max(event_id), 0) from event").fetchone()[0], 100000)
    for table in TABLES:
        columns = [name for _, name, *_ in db.execute(f"pragma table_info({table})")]
        values = ", ".join("participant || '-' || :k" if (table, name) == ("session", "participant")
                           else f"{name} + :k * {apart}" if name in IDS else name for name in columns)
        rows = f"insert into {table} ({', '.join(columns)}) select {values} from {table} where "
        own = ("trial_id" if "session_id" not in columns else "session_id") + f" < {apart}"
        for k in range(1, n_copies + 1):
            db.execute(rows + own, {"k": k})
    db.commit()
    db.close()


def peak_kb(log):
    process = subprocess.Popen([heft, "analyse", "--unverified", "--db", log], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return usage.ru_maxrss


@unittest.skipIf("ASAN_OPTIONS" in os.environ, "a sanitizer's memory is its own")
class Memory(unittest.TestCase):
    def test_grows_little_with_participants(self):
        with tempfile.TemporaryDirectory() as folder:
            few, many = Path(folder) / "few.db", Path(folder) / "many.db"
            subprocess.run([heft, "simulate", PROTOCOL, "--participants", "2", "--seed", "1", "--db",
                            few], check=True, stderr=subprocess.DEVNULL)
            shutil.copy(few, many)
            copy_sessions(few, 49)
            copy_sessions(many, 249)
            grown = (peak_kb(many) - peak_kb(few)) / 400
            self.assertLess(grown, MOST_KB, "kB a participant")


if __name__ == "__main__":
    heft = os.path.abspath(sys.argv.pop(1))
    unittest.main()

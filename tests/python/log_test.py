"""heft.read_log and heft.simulate: the rows of the log, and nothing written beside it.

Run: PYTHONPATH=build/python python3 tests/python/log_test.py build/heft
"""
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import pandas  # before sessions start: it takes as long as one

import heft

PROGRAM = Path(sys.argv.pop(1)).resolve()
PROTOCOLS = Path(__file__).resolve().parents[2] / "protocols"


def rows_of(log):
    """All rows by table."""
    with sqlite3.connect(log) as connection:
        names = [name for name, in connection.execute(
            "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%'")]
        return {name: connection.execute(f"SELECT * FROM {name}").fetchall() for name in names}


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if not path.name.endswith("-shm")}


class Logs(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.log = self.folder / "lab.db"

    def simulated(self, *options):
        return heft.simulate(PROTOCOLS / "jnd.toml", 2, 1, self.log, *options)


class Simulate(Logs):
    def test_stores_the_rows_of_the_program(self):
        self.assertEqual(self.simulated(), self.log)
        other = self.folder / "other.db"
        subprocess.run([PROGRAM, "simulate", PROTOCOLS / "jnd.toml", "--participants", "2", "--seed",
                        "1", "--db", other], capture_output=True, check=True)
        found, expected = (heft.read_log(log, ["trial", "answer", "reversal", "estimate", "cube"])
                           for log in (self.log, other))
        for name, frame in expected.items():
            self.assertGreater(len(frame), 0)
            self.assertTrue(frame.equals(found[name]), name)

    def test_takes_options_of_the_program(self):
        self.simulated("--responder", "coin")
        self.assertEqual(set(heft.read_log(self.log)["setup"].responder), {"coin"})

    def test_mistakes(self):
        wrong = self.folder / "wrong.toml"
        wrong.write_text("title = 3\n")
        with self.assertRaisesRegex(ValueError, r"wrong.toml:1:\d+: title is 3"):
            heft.simulate(wrong, 1, 1, self.log)
        with self.assertRaisesRegex(ValueError, "participants"):
            heft.simulate(PROTOCOLS / "jnd.toml", 0, 1, self.log)
        with self.assertRaises(FileNotFoundError):
            heft.simulate(self.folder / "none.toml", 1, 1, self.log)
        self.assertFalse(self.log.exists())


class ReadLog(Logs):
    def test_has_every_table_and_view_with_all_rows(self):
        self.simulated()
        frames = heft.read_log(self.log)
        rows = rows_of(self.log)
        self.assertEqual({name for name in frames if not name.startswith("v_")}, rows.keys())
        self.assertLessEqual({"v_trial", "v_sorting", "v_jnd", "v_frame"}, frames.keys())
        for name, expected in rows.items():
            self.assertEqual(len(frames[name]), len(expected), name)
        self.assertGreater(len(rows["trial"]), 100)
        levels = [level for level, in sqlite3.connect(self.log).execute(
            "SELECT level_g FROM v_trial WHERE level_g IS NOT NULL")]
        self.assertEqual(list(frames["v_trial"].level_g.dropna()), levels)

    def test_has_units(self):
        self.simulated()
        frames = heft.read_log(self.log)
        units = frames["v_trial"].attrs["units"]
        self.assertEqual((units["level_g"], units["response_time_s"]), ("g", "s"))
        self.assertNotIn("outcome", units)
        ends = {"_s": "s", "_g": "g", "_m": "m", "_px": "px", "_hz": "Hz", "_mm": "mm"}
        of = {column: unit for frame in frames.values() for column, unit in frame.attrs["units"].items()}
        self.assertGreater(len(of), 60)
        for column, unit in of.items():
            end = next((end for end in ends if column.endswith(end)), None)
            if end and "/" not in unit:
                self.assertEqual(unit, ends[end], column)

    def test_reads_the_tables_asked_for(self):
        self.simulated()
        self.assertEqual(list(heft.read_log(self.log, ["v_jnd", "trial"])), ["v_jnd", "trial"])
        with self.assertRaisesRegex(ValueError, "no table 'trials'; expected .*trial"):
            heft.read_log(self.log, ["trials"])

    def test_writes_nothing_beside_the_log(self):
        self.simulated()
        before = contents(self.folder)
        heft.read_log(self.log)
        self.assertEqual(contents(self.folder), before)
        self.assertEqual(list(before), ["lab.db"])
        self.assertFalse(Path(f"{self.log}-shm").exists())

    def test_refuses_other_files(self):
        with self.assertRaises(FileNotFoundError):
            heft.read_log(self.log)
        self.assertEqual(os.listdir(self.folder), [])
        self.log.write_text("level,response\n1,0\n" * 100)
        with self.assertRaisesRegex(ValueError, "lab.db is no heft log"):
            heft.read_log(self.log)
        other = self.folder / "other.db"
        sqlite3.connect(other).execute("CREATE TABLE trial (level_g)")
        with self.assertRaisesRegex(ValueError, "other.db is no heft log"):
            heft.read_log(other)


class RunningSession(Logs):
    def start(self):
        process = subprocess.Popen(
            [PROGRAM, "run", PROTOCOLS / "recommended.toml", "--participant", "01", "--responder",
             "simulated", "--seed", "5", "--db", self.log], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        until = time.monotonic() + 60
        while time.monotonic() < until and process.poll() is None:
            try:
                if len(heft.read_log(self.log, ["trial"])["trial"]) > 3:
                    break
            except (OSError, ValueError, sqlite3.Error):
                pass  # the log is being made
            time.sleep(0.02)
        self.assertIsNone(process.poll(), "the session ended before it could be read")
        return process

    def test_is_read_with_its_newest_rows_and_continues(self):
        process = self.start()
        n = len(heft.read_log(self.log, ["trial"])["trial"])
        while len(heft.read_log(self.log, ["trial"])["trial"]) == n and process.poll() is None:
            time.sleep(0.02)
        self.assertEqual(process.wait(timeout=120), 0)
        subprocess.run([PROGRAM, "replay", "--db", self.log], capture_output=True, check=True)

    def test_that_was_killed_is_read_unchanged(self):
        process = self.start()
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertGreater(Path(f"{self.log}-wal").stat().st_size, 0)
        before = contents(self.folder)
        trials = heft.read_log(self.log)["trial"]
        self.assertGreater(len(trials), 3)
        self.assertEqual(contents(self.folder), before)
        # The same files, copied without SQLite's -shm.
        copied = self.folder / "copied"
        copied.mkdir()
        for end in ("", "-wal"):
            shutil.copy(f"{self.log}{end}", copied)
        before = contents(copied)
        self.assertEqual(len(heft.read_log(copied / "lab.db")["trial"]), len(trials))
        self.assertEqual(contents(copied), before)
        self.assertEqual(sorted(path.name for path in copied.iterdir()), ["lab.db", "lab.db-wal"])


if __name__ == "__main__":
    unittest.main()

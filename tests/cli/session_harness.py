"""Running sessions from tests: the program, its logs, and what must be equal in two of them."""
import os
import re
import sqlite3
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROTOCOLS = ROOT / "protocols"

# Of every completed trial: what was drawn, shown and answered. Times count from the trial's start,
# as an interruption shifts everything after it.
TRIALS = """
select trial_number, attempt, block, task, condition, staircase, reference_g, level_g, is_catch,
       status, outcome, chosen_slot, reference_slot, choice_correct, shown_s - started_s,
       first_contact_s - started_s, first_choice_s - started_s, validated_s - started_s, paused_s,
       lost_s, ended_s - started_s
from trial where status = 'completed' order by trial_number"""
CUBES = """
select trial_number, slot, mass_g, n_pushes, contact_s, cube.first_contact_s - started_s,
       cube.last_contact_s - started_s
from cube join trial using (trial_id) where status = 'completed' order by trial_number, slot"""
ANSWERS = """
select trial_number, t_s - started_s, action, slot, label
from answer join trial using (trial_id) where status = 'completed' order by answer_id"""
REVERSALS = """
select reversal.staircase, number, trial_number, reversal.level_g, step_before_g, step_after_g
from reversal join trial using (trial_id) order by reversal.staircase, number"""
ESTIMATES = """
select staircase, method, jnd_g, low_g, high_g, n_trials, n_reversals, n_floor, n_ceiling, reason
from estimate order by staircase"""
FRAMES = """
select trial_number, trial_t_s, state_hash
from frame join trial using (trial_id) where status = 'completed' order by frame_id"""


def commands_in(said):
    """The commands that a --help lists, one a line or in the row of minor ones."""
    row = re.search(r"^  also: (.*)", said, re.M)
    return re.findall(r"^  ([a-z][a-z-]*)\s", said, re.M) + (row[1].split() if row else [])


def rows_of(db):
    """All rows of all tables, as SQL. Two files with the same rows may differ in how pages are laid out."""
    with sqlite3.connect(db) as connection:
        return list(connection.iterdump())


def query(db, sql):
    connection = sqlite3.connect(f"file:{db}?mode=ro", uri=True)
    try:
        return connection.execute(sql).fetchall()
    finally:
        connection.close()


def change(db, sql):
    connection = sqlite3.connect(db)
    try:
        with connection:
            return connection.execute(sql).rowcount
    finally:
        connection.close()


def outcome_of(db, frames=False):
    """Rows that an interruption must not change."""
    parts = [TRIALS, CUBES, ANSWERS, REVERSALS, ESTIMATES] + ([FRAMES] if frames else [])
    return [query(db, sql) for sql in parts]


class SessionTest(unittest.TestCase):
    heft = None  # path of the program

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="heft-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_heft(self, *words, expect=0, timeout=300, **options):
        done = subprocess.run([self.heft, *map(str, words)], capture_output=True, text=True,
                              timeout=timeout, **options)
        if expect is not None:
            self.assertEqual(done.returncode, expect, f"{words}\n{done.stdout}\n{done.stderr}")
        return done

    def session(self, db, *words, protocol="quick", participant="01", seed=5, **options):
        return self.run_heft("run", PROTOCOLS / f"{protocol}.toml", "--participant", participant,
                             "--responder", "simulated", "--seed", seed, "--db", db, *words,
                             **options)

    def start_until_under_way(self, db):
        """A session of jnd.toml, seed 5, returned as soon as two trials are completed."""
        process = subprocess.Popen(
            [self.heft, "run", PROTOCOLS / "jnd.toml", "--participant", "01", "--responder",
             "simulated", "--seed", "5", "--db", db], stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not self.is_under_way(db):
            time.sleep(0.01)
        self.assertIsNone(process.poll(), "it was over before it could be stopped")
        return process

    def kill_under_way(self, db):
        process = self.start_until_under_way(db)
        process.kill()
        process.communicate()

    @staticmethod
    def is_under_way(db):
        try:
            return query(db, "select count(*) from trial where status = 'completed'") > [(1,)]
        except sqlite3.Error:  # the file is still being made
            return False


def main(module):
    import sys
    SessionTest.heft = os.path.abspath(sys.argv.pop(1))
    unittest.main(module=module)

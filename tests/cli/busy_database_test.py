"""Another process locks the database at random moments of a session: the session waits, or is killed
meanwhile and resumed, and its log equals that of a session without a lock. HEFT_MOMENTS sets the
number of moments, HEFT_SEED repeats a failure.

Run: python3 tests/cli/busy_database_test.py PATH_TO_HEFT [-v]
"""
import os
import random
import sqlite3
import time

from session_harness import SessionTest, main, outcome_of

MOMENTS = int(os.environ.get("HEFT_MOMENTS", 6))
SEED = int(os.environ.get("HEFT_SEED", random.randrange(10**6)))


class BusyDatabase(SessionTest):
    def test_locks_at_random_moments_change_no_outcome(self):
        whole = self.folder / "whole.db"
        self.session(whole, protocol="jnd")
        expected = outcome_of(whole, frames=True)
        for n in range(MOMENTS):
            with self.subTest(seed=SEED, moment=n):
                db = self.folder / f"{n}.db"
                self.lock_once(db, random.Random(f"{SEED} {n}"))
                self.run_heft("replay", "--db", db)
                self.assertEqual(outcome_of(db, frames=True), expected)
                db.unlink()

    def lock_once(self, db, chance):
        process = self.start_until_under_way(db)
        time.sleep(0.5 * chance.random())
        other = sqlite3.connect(db, isolation_level=None, timeout=5)
        try:
            other.execute("begin immediate")
            time.sleep(2.5 * chance.random())  # a write waits for 1 s before the session does
            is_killed = chance.random() < 0.4
            if is_killed:
                process.kill()
            other.execute("rollback")
        finally:
            other.close()
        _, talk = process.communicate(timeout=120)
        if is_killed and process.returncode != 0:  # it may have been over
            self.run_heft("resume", "--db", db)
        else:
            self.assertEqual(process.returncode, 0, talk)


if __name__ == "__main__":
    main("__main__")

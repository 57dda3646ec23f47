"""kill -9 at random moments, a full disk, a read-only log: nothing acknowledged is lost.

Run: python3 tests/cli/interruption_test.py PATH_TO_HEFT [-v]
HEFT_KILLS sets how many sessions are killed (default 40).
"""
import os
import random
import shutil
import signal
import subprocess
import time
from pathlib import Path

from session_harness import PROTOCOLS, SessionTest, change, main, outcome_of, query


class Killed(SessionTest):
    def start(self, *words):
        return subprocess.Popen([self.heft, *map(str, words)], stderr=subprocess.PIPE,
                                stdout=subprocess.DEVNULL, text=True)

    def run_words(self, db):
        return ("run", PROTOCOLS / "quick.toml", "--participant", "01", "--responder", "simulated",
                "--seed", 5, "--db", db)

    def kill_at_random(self, words, longest_s, rng):
        process = self.start(*words)
        time.sleep(rng.uniform(0, longest_s))
        process.send_signal(signal.SIGKILL)
        process.communicate()
        return process.returncode == -signal.SIGKILL

    def test_killed_sessions_resume_to_the_same_end(self):
        whole = self.folder / "whole.db"
        started = time.monotonic()
        self.session(whole)
        longest_s = time.monotonic() - started
        expected = outcome_of(whole, frames=True)
        rng = random.Random(20261121)
        n_killed = n_not_started = n_voided = 0
        for n in range(int(os.environ.get("HEFT_KILLS", "40"))):
            db = self.folder / f"{n}.db"
            if not self.kill_at_random(self.run_words(db), longest_s, rng):
                continue
            n_killed += 1
            acknowledged = self.acknowledged(db)
            # One in three is killed again while it resumes.
            if acknowledged is not None and n % 3 == 0:
                self.kill_at_random(("resume", "--db", db), longest_s, rng)
            if acknowledged is None:
                n_not_started += 1  # the file is not there yet or empty: the same command starts it
                self.run_heft("resume", "--db", db, expect=1)
                self.run_heft(*self.run_words(db))
            elif query(db, "select state from session") != [("finished",)]:
                self.run_heft("resume", "--db", db)
            with self.subTest(kill=n):
                self.assertEqual(query(db, "pragma integrity_check"), [("ok",)])
                self.assertEqual(query(db, "pragma foreign_key_check"), [])
                self.assertEqual(outcome_of(db, frames=True), expected)
                self.assertEqual(query(db, "select state from session"), [("finished",)])
                kept = query(db, "select event_id, t_s, kind, slot, label, detail from event")
                self.assertEqual(kept[:len(acknowledged or [])], acknowledged or [])
                voids = query(db, "select attempt, void_reason from trial where status = 'void'")
                n_voided += bool(voids)
                self.assertLessEqual(set(voids), {(1, "interrupted")})
                self.run_heft("replay", "--db", db)
        self.assertGreater(n_killed, 5)
        self.assertGreater(n_voided, 0, "no kill came inside a trial; the test shows nothing")
        print(f"{n_killed} killed, {n_not_started} before the session was saved, "
              f"{n_voided} inside a trial")

    def acknowledged(self, db):
        """The events in the file as the kill left it; None where no session is in it yet."""
        if not db.exists() or db.stat().st_size == 0:
            return None
        shutil.copy(db, self.folder / "copy.db")
        for suffix in ("-wal",):
            if os.path.exists(f"{db}{suffix}"):
                shutil.copy(f"{db}{suffix}", self.folder / f"copy.db{suffix}")
        try:
            import sqlite3
            connection = sqlite3.connect(self.folder / "copy.db")
            rows = connection.execute(
                "select event_id, t_s, kind, slot, label, detail from event").fetchall()
            n = connection.execute("select count(*) from session").fetchone()[0]
            connection.close()
            return rows if n else None
        except Exception:
            return None
        finally:
            for suffix in ("", "-wal", "-shm"):
                if os.path.exists(f"{self.folder}/copy.db{suffix}"):
                    os.remove(f"{self.folder}/copy.db{suffix}")

    # A power cut leaves any part of what was written last: the tail of the -wal file is torn.
    def test_power_cuts_that_tear_the_last_writes_resume_to_the_same_end(self):
        whole = self.folder / "whole.db"
        self.session(whole, protocol="jnd")
        expected = outcome_of(whole, frames=True)
        rng = random.Random(20261128)
        db = self.folder / "s.db"
        process = self.start_until_under_way(db)
        cuts = []
        for _ in range(3):
            process.send_signal(signal.SIGSTOP)
            cuts.append((db.read_bytes(), Path(f"{db}-wal").read_bytes()))
            process.send_signal(signal.SIGCONT)
            time.sleep(0.02)
        process.kill()
        process.communicate()
        for pages, tail in cuts:
            n_torn = rng.randrange(1, 3 * 4096)
            kept = tail[:-n_torn]
            torn = rng.choice([kept, kept + bytes(n_torn), kept + rng.randbytes(n_torn),
                               tail + tail[-n_torn:]])
            with self.subTest(n_torn=n_torn, n_bytes=len(torn)):
                Path(f"{db}-shm").unlink(missing_ok=True)
                db.write_bytes(pages)
                Path(f"{db}-wal").write_bytes(torn)
                self.run_heft("analyse", "--db", db, "--json")
                self.run_heft("resume", "--db", db)
                self.run_heft("replay", "--db", db)
                self.assertEqual(outcome_of(db, frames=True), expected)

    def test_a_damaged_file_is_not_called_changed(self):
        db = self.folder / "s.db"
        self.kill_under_way(db)
        change(db, "pragma wal_checkpoint(truncate)")
        [(page,)] = query(db, "select rootpage from sqlite_master where name = 'event_by_session'")
        content = bytearray(db.read_bytes())
        content[(page - 1) * 4096 + 4] -= 1  # the index lacks an entry
        db.write_bytes(content)
        refused = self.run_heft("resume", "--db", db, expect=5).stderr
        self.assertIn("the file is damaged", refused)
        self.assertIn("continue with a backup", refused)

    def test_the_gap_is_logged_and_time_continues(self):
        db = self.folder / "s.db"
        self.kill_under_way(db)
        self.run_heft("resume", "--db", db)
        [(gap_s,)] = query(db, "select value from event where kind = 'resumed'")
        self.assertGreaterEqual(gap_s, 0)
        times = [t for (t,) in query(db, "select t_s from event order by event_id")]
        self.assertEqual(times, sorted(times))


class FullDisk(SessionTest):
    """On a small tmpfs; skipped where this user can't mount one."""

    def setUp(self):
        super().setUp()
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", self.disk],
                                 capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("this user can't mount a tmpfs")
        self.addCleanup(subprocess.run, ["umount", "-l", str(self.disk)])

    def test_a_full_disk_stops_the_session_with_a_clear_error_and_nothing_is_lost(self):
        db = self.disk / "s.db"
        done = self.session(db, protocol="jnd", expect=1)
        self.assertIn("full", done.stderr)
        self.assertIn("heft resume", done.stderr)
        self.assertEqual(query(db, "pragma integrity_check"), [("ok",)])
        # With more space the session can be resumed.
        subprocess.run(["mount", "-o", "remount,size=64m", self.disk], check=True)
        self.run_heft("resume", "--db", db)
        whole = self.folder / "whole.db"
        self.session(whole, protocol="jnd")
        self.assertEqual(outcome_of(db), outcome_of(whole))

    def test_a_read_only_log_is_refused_before_the_session_starts(self):
        subprocess.run(["mount", "-o", "remount,size=64m", self.disk], check=True)
        db = self.disk / "s.db"
        self.session(db)
        subprocess.run(["mount", "-o", "remount,ro", self.disk], check=True)
        done = self.session(db, participant="02", expect=1)
        self.assertIn("s.db", done.stderr)
        self.assertIn("Read-only", done.stderr)
        self.run_heft("analyse", "--db", db, "--json")


if __name__ == "__main__":
    main("__main__")

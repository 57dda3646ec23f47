"""Privacy: withdrawal, modes of files, pseudonymised exports.

Run: python3 tests/cli/record/privacy_test.py PATH_TO_HEFT
"""
import json
import os
import shutil
import sqlite3
import stat

from log_harness import SEED, TINY, LogTest
from session_harness import change, main, query


class Withdrawal(LogTest):
    def test_nothing_of_the_person_remains_in_the_log(self):
        self.people()
        withdrawn = "P02"
        [(seed, started)] = query(
            self.db, f"select seed, started_utc from session where participant = '{withdrawn}'")
        self.assertIn(withdrawn.encode(), self.db.read_bytes())
        done = self.run_heft("withdraw", "--db", self.db, "--session", 2, "--yes")
        self.assertIn("head of the log: " + self.head()[:12], done.stdout)
        for file in self.folder.iterdir():
            for trace in (withdrawn, str(seed), started):
                self.assertFalse(trace.encode() in file.read_bytes(), f"{trace} in {file}")
        for table in ("event", "frame", "setup", "trial", "reversal", "estimate",
                      "participant_info", "participant_parameter"):
            self.assertEqual(query(self.db, f"select count(*) from {table} where session_id = 2"),
                             [(0,)], table)
        self.assertEqual(query(self.db, "pragma integrity_check"), [("ok",)])

    # Also the state that a power cut after the withdrawal's commit leaves.
    def test_an_open_reader_is_named_and_the_repeated_command_overwrites_the_rows(self):
        self.people(2)
        [(started,)] = query(self.db, "select started_utc from session where session_id = 2")
        reader = sqlite3.connect(f"file:{self.db}?mode=ro", uri=True, isolation_level=None)
        reader.execute("begin")
        reader.execute("select count(*) from event").fetchall()
        words = ("withdraw", "--db", self.db, "--session", 2, "--yes")
        done = self.run_heft(*words, expect=1)
        self.assertIn("session 2 is withdrawn; head", done.stdout)
        self.assertIn("can still be read from the file", done.stderr)
        self.assertIn("another program has the log open. Close it, then repeat: heft withdraw",
                      done.stderr)
        self.assertIn(started.encode(), self.db.read_bytes())
        reader.close()
        self.assertIn("nothing of it is left", self.run_heft(*words, expect=2).stderr)
        self.assertNotIn(started.encode(), self.db.read_bytes())
        shown = self.run_heft("show", "--db", self.db, "--session", 2).stdout
        self.assertRegex(shown, r"session 2: its data were withdrawn at \d{4}-[^{]*; head")

    def test_replay_analyse_and_export_accept_it(self):
        self.people()
        before = self.head()
        self.run_heft("withdraw", "--db", self.db, "--session", 2, "--yes")
        self.assertIn("session 2: withdrawn", self.run_heft("replay", "--db", self.db).stdout)
        self.run_heft("replay", "--db", self.db, "--witness", before)  # of the third session
        summary = json.loads(self.run_heft("analyse", "--db", self.db, "--json").stdout)
        flow = summary["participant_flow"]
        self.assertEqual([flow["n_asked"], flow["n_withdrawn"], flow["n_started"]], [3, 1, 2])
        self.assertEqual(summary["n_participants"], 2)
        self.run_heft("export", self.db, "--out", self.folder / "data")
        people = self.rows(self.folder / "data" / "participants.csv")
        self.assertEqual([row["participant"] for row in people], ["P01", "P03"])
        self.assertIn("withdrawn", self.run_heft("list", "--db", self.db).stdout)
        self.run_heft("show", "--db", self.db, "--session", 2)
        self.run_heft("resume", "--db", self.db, "--session", 2, expect=1)
        self.people(4, expect=None)
        self.run_heft("replay", "--db", self.db)

    def test_copies_are_listed(self):
        self.people(1)
        self.session(self.db, "--backup", self.folder / "copies", participant="P02")
        self.run_heft("export", self.db, "--out", self.folder / "data")
        kept = [f"lab.db.{name}" for name in ("old", "v6", "v7", "v8")] + ["a copy", "copy.sqlite"]
        for name in kept:
            shutil.copy(self.db, self.folder / name)
        done = self.run_heft("withdraw", "--db", self.db, "--session", 2, "--yes")
        for copy in ("copies/P02_session2", *kept, "data (10 files"):
            self.assertIn(copy, done.stdout)
        listed = self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes").stdout
        # First the copies, because nothing names the person if it is killed afterwards.
        self.assertLess(listed.index("copies, in"), listed.index("session 1 is withdrawn"))
        self.assertIn("copies/P02_session2", listed)  # which has the first session, too

    def test_other_sessions_of_the_person_are_named(self):
        self.people(2)
        self.session(self.db, "--again", participant="P01")
        done = self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes").stdout
        self.assertIn("session 3 is of participant P01, too", done)
        self.assertNotIn("session 2 is", done)
        self.assertNotIn("too", self.run_heft("withdraw", "--db", self.db, "--session", 3,
                                              "--yes").stdout)

    def test_an_id_of_a_withdrawn_session_is_not_given_again(self):
        shutil.copy(TINY, self.folder)
        plan = self.folder / "STUDY.toml"
        plan.write_text('study = "s"\nparticipants = 3\nseed = 1\nprotocol = "tiny.toml"\n'
                        'db = "lab.db"\n')
        for _ in range(2):
            self.run_heft("run", "--plan", plan, "--responder", "simulated")
        self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes")
        self.run_heft("withdraw", "--db", self.db, "--session", 2, "--yes")
        self.run_heft("replay", "--db", self.db)
        for _ in range(2):
            self.run_heft("run", "--plan", plan, "--responder", "simulated")
        self.run_heft("withdraw", "--db", self.db, "--session", 3, "--yes")
        self.run_heft("run", "--plan", plan, "--responder", "simulated")
        ids = [name for (name,) in query(self.db, "select participant from session")]
        self.assertEqual(ids, ["", "", "", "simulated-02b", "simulated-01c"])
        self.assertRegex(self.run_heft("list", "--db", self.db).stdout, "s 1 of 3")

    def test_it_is_neither_done_by_accident_nor_twice(self):
        self.people(1)
        self.run_heft("withdraw", "--db", self.db, expect=2)
        self.run_heft("withdraw", "--db", self.db, "--session", 1, expect=2)  # no --yes
        self.run_heft("withdraw", "--db", self.db, "--session", 9, "--yes", expect=1)
        self.assertEqual(query(self.db, "select state from session"), [("finished",)])
        self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes")
        self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes", expect=2)

    def test_a_changed_log_is_left_as_it_is(self):
        self.people(2)
        change(self.db, "update trial set level_g = 1 where trial_id = 1")
        withdraw = ("withdraw", "--db", self.db, "--session", 2, "--yes")
        refused = self.run_heft(*withdraw, expect=5)
        self.assertIn("session 1", refused.stderr)
        self.assertIn("--unverified", refused.stderr)
        self.assertEqual(query(self.db, "select distinct state from session"), [("finished",)])
        self.run_heft(*withdraw, "--unverified")
        self.assertEqual(query(self.db, "select state from session"),
                         [("finished",), ("withdrawn",)])

    def test_a_removal_by_hand_is_noticed(self):
        self.people(2)
        copy = self.folder / "copy.db"
        shutil.copy(self.db, copy)
        self.run_heft("withdraw", "--db", copy, "--session", 1, "--yes")
        rows = query(copy, "select * from session where session_id = 1")
        for table in ("cube", "answer"):
            change(self.db, f"delete from {table} where trial_id in "
                            "(select trial_id from trial where session_id = 1)")
        for table in ("frame", "event", "reversal", "estimate", "participant_parameter", "trial",
                      "setup", "session"):
            change(self.db, f"delete from {table} where session_id = 1")
        connection = sqlite3.connect(self.db)
        connection.executemany(f"insert into session values ({','.join('?' * len(rows[0]))})", rows)
        connection.commit()
        connection.close()
        self.run_heft("replay", "--db", self.db, expect=5)


class Privacy(LogTest):
    def test_all_files_are_their_owners(self):
        self.people(1)
        os.umask(0o022)
        self.run_heft("analyse", "--db", self.db, "--out", self.folder / "new" / "report")
        for form in ("csv", "bids", "psych-ds"):
            self.run_heft("export", self.db, "--format", form, "--out", self.folder / form,
                          "--pseudonymise")
        for path in self.folder.rglob("*"):
            mode = stat.S_IMODE(path.stat().st_mode)
            self.assertEqual(mode & 0o077, 0, f"{path}: {mode:o}")

    # Ids, seeds, order of rows and dates must not identify participants. Measurements may: the drawn
    # parameters of a simulated one do.
    def test_a_pseudonymised_export_shows_nothing_about_who_took_part_when(self):
        n, n_exports = 26, 4
        self.run_heft("simulate", TINY, "--participants", n, "--db", self.db, "--seed", SEED)
        earlier = self.exported("earlier")
        found = dict.fromkeys(("session_id", "order", "first trial_id"), 0)
        for i in range(n_exports):
            shared = self.exported(f"shared{i}", "--pseudonymise", "--key", self.folder / "key")
            for rows in shared.values():
                for secret in ("seed", "operator", "run_options", "settings"):
                    self.assertNotIn(secret, rows[0])
            self.assertEqual({len(row["started_utc"]) for row in shared["participants"]}, {4})
            self.assertEqual({len(row["date"]) for row in shared["wide"]}, {4})
            for attack, known in (("session_id", lambda row, place: row["session_id"]),
                                  ("order", lambda row, place: place)):
                name_of = {known(row, place): row["participant"]
                           for place, row in enumerate(earlier["participants"])}
                found[attack] += sum(self.name_in(earlier, row) == name_of.get(known(row, place))
                                     for place, row in enumerate(shared["participants"]))
            first = {row["session_id"]: row["trial_id"] for row in reversed(earlier["trials"])}
            name_of = {first[row["session_id"]]: row["participant"]
                       for row in earlier["participants"]}
            first = {row["session_id"]: row["trial_id"] for row in reversed(shared["trials"])}
            found["first trial_id"] += sum(
                self.name_in(earlier, row) == name_of.get(first[row["session_id"]])
                for row in shared["participants"])
        for attack, n_found in found.items():  # one of n in each export by chance
            self.assertLess(n_found, 4 * n_exports, f"{attack}, seed {SEED}")

    def exported(self, name, *words):
        folder = self.folder / name
        self.run_heft("export", self.db, "--out", folder, *words)
        return {table: self.rows(folder / f"{table}.csv")
                for table in ("participants", "trials", "setups", "answers", "wide")}

    @staticmethod
    def name_in(earlier, person):
        drawn = [key for key in person if key.startswith("parameter_")]
        [name] = {row["participant"] for row in earlier["participants"]
                  if all(row[key] == person[key] for key in drawn)}
        return name

    def test_sessions_of_a_person_keep_their_order(self):
        for i in range(4):
            self.run_heft("run", TINY, "--participant", f"P{i % 2}", "--responder", "simulated",
                          "--seed", i, "--db", self.db, *(["--again"] if i > 1 else []))
        earlier, shared = self.exported("earlier"), self.exported("shared", "--pseudonymise")
        by_person = {}
        for row in shared["participants"]:
            by_person.setdefault(row["person"], []).append(self.place_in(earlier, row))
        self.assertEqual(sorted(by_person.values()), [[0, 2], [1, 3]])

    @staticmethod
    def place_in(earlier, session):
        drawn = [key for key in session if key.startswith("parameter_")]
        [place] = [i for i, row in enumerate(earlier["participants"])
                   if all(row[key] == session[key] for key in drawn)]
        return place


if __name__ == "__main__":
    main("__main__")

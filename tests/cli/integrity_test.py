"""Integrity of logs: no figure from a changed log, heads as witnesses, withdrawal, privacy.

Run: python3 tests/cli/integrity_test.py PATH_TO_HEFT
"""
import csv
import json
import os
import random
import re
import shutil
import sqlite3
import stat

from session_harness import PROTOCOLS, ROOT, SessionTest, change, main, query

TINY = ROOT / "tests" / "golden" / "logs" / "tiny.toml"
SEED = int(os.environ.get("HEFT_SEED", random.randrange(10**9)))
N_CHANGES = int(os.environ.get("HEFT_CHANGES", 40))


class Integrity(SessionTest):
    def setUp(self):
        super().setUp()
        self.db = self.folder / "lab.db"
        self.draws = random.Random(SEED)

    def people(self, n=3, **options):
        for i in range(1, n + 1):
            self.run_heft("run", TINY, "--participant", f"P{i:02}", "--responder", "simulated",
                          "--seed", 7_536_912_775_689_988_440 + i, "--db", self.db, **options)
        return self.db

    @staticmethod
    def rows(file):
        with file.open(encoding="utf-8") as lines:
            return list(csv.DictReader(lines))

    def head(self, db=None):
        return query(db or self.db, "select head from seal order by seal_id desc limit 1")[0][0]


class Figures(Integrity):
    def refuses(self, db, what):
        for words in (["analyse", "--db", db], ["analyse", "--db", db, "--json"],
                      ["export", db, "--out", self.folder / "refused"]):
            done = self.run_heft(*words, expect=None)
            self.assertIn(done.returncode, (1, 5), f"{what}\n{done.stdout}{done.stderr}")
            self.assertEqual(done.stdout, "", what)
            self.assertFalse((self.folder / "refused").exists(), what)

    def test_no_figure_comes_from_edited_cells(self):
        self.people()
        for _ in range(N_CHANGES):
            db = self.folder / "edited.db"
            shutil.copy(self.db, db)
            what = self.edit_a_cell(db)
            with self.subTest(seed=SEED, what=what):
                self.refuses(db, what)

    def edit_a_cell(self, db):
        connection = sqlite3.connect(db)
        connection.execute("pragma ignore_check_constraints = on")
        while True:
            table = self.draws.choice(["session", "setup", "event", "trial", "cube", "answer",
                                       "reversal", "estimate", "frame", "participant_parameter",
                                       "seal"])
            columns = [row[1] for row in connection.execute(f"pragma table_info({table})")]
            column = self.draws.choice(columns)
            rows = [row[0] for row in connection.execute(f"select rowid from {table}")]
            row = self.draws.choice(rows)
            [(old,)] = connection.execute(f"select {column} from {table} where rowid = ?", (row,))
            new = {int: lambda: old + 1, float: lambda: old + 0.25, str: lambda: old + "x",
                   type(None): lambda: "1"}[type(old)]()
            try:
                connection.execute(f"update {table} set {column} = ? where rowid = ?", (new, row))
            except sqlite3.Error:  # a key or a type
                continue
            connection.commit()
            connection.close()
            return f"{table}.{column} of row {row}: {new!r} instead of {old!r}"

    # Changes in unused parts of pages do not count.
    def test_no_figure_comes_from_flipped_bits_in_rows(self):
        self.people(2)
        change(self.db, "vacuum")
        whole = self.dump(self.db)
        n_left = N_CHANGES // 2
        while n_left > 0:
            db = self.folder / "flipped.db"
            content = bytearray(self.db.read_bytes())
            at = self.draws.randrange(100, len(content))
            content[at] ^= 1 << self.draws.randrange(8)
            db.write_bytes(content)
            if self.dump(db) == whole:
                continue
            n_left -= 1
            with self.subTest(seed=SEED, byte=at):
                self.refuses(db, f"byte {at}")

    @staticmethod
    def dump(db):
        try:
            connection = sqlite3.connect(f"file:{db}?mode=ro", uri=True)
            connection.text_factory = bytes
            return [[connection.execute(f"select rowid, * from {name.decode()}").fetchall()]
                    for (name,) in connection.execute(
                        "select name from sqlite_master where type = 'table'").fetchall()]
        except (sqlite3.Error, UnicodeDecodeError, OverflowError) as error:
            return str(error)

    def test_a_refusal_to_resume_counts_rows_and_its_command_can_be_copied(self):
        db = self.folder / "my lab.db"
        self.kill_under_way(db)
        change(db, "delete from frame where frame_id = (select max(frame_id) from frame)")
        refused = self.run_heft("resume", "--db", db, expect=5).stderr
        self.assertRegex(refused, r"rows is \d+ events and \d+ frames, but .* give \d+ events")
        self.assertIn(f"heft replay --db '{db}' --session 1", refused)

    def test_unverified_figures_are_marked_everywhere(self):
        self.people(1)
        change(self.db, "update trial set outcome = 'correct' where outcome = 'incorrect'")
        change(self.db, "update estimate set jnd_g = 1")
        self.refuses(self.db, "outcomes")
        report, data = self.folder / "report", self.folder / "data"
        done = self.run_heft("analyse", "--db", self.db, "--unverified", "--out", report)
        self.assertIn("NOT VERIFIED", done.stdout)
        self.run_heft("export", self.db, "--unverified", "--out", data)
        for file in [*report.glob("*.csv"), *report.glob("*.svg"), report / "report.html",
                     report / "summary.json"]:
            text = file.read_text()
            if file.suffix == ".csv" and text.count("\n") < 2:
                continue  # no row
            self.assertTrue("NOT VERIFIED" in text, file)
        self.assertFalse(json.loads((report / "summary.json").read_text())["verified"])
        for file in data.glob("*.csv"):
            for row in self.rows(file):
                self.assertEqual(row["unverified"], "1", file)

    def test_verified_figures_name_the_head(self):
        self.people(1)
        head = self.head()[:12]
        self.assertIn(f"verified, head {head}",
                      re.sub(r"\s+", " ", self.run_heft("analyse", "--db", self.db).stdout))
        summary = json.loads(self.run_heft("analyse", "--db", self.db, "--json").stdout)
        self.assertTrue(summary["verified"])
        self.assertIn(head, summary["integrity"])
        report = self.folder / "report"
        self.run_heft("analyse", "--db", self.db, "--out", report)
        self.assertIn(head, (report / "report.html").read_text())


class Several(Integrity):
    def test_what_they_have_in_common_is_said_once(self):
        self.people()
        replayed = self.run_heft("replay", "--db", self.db).stdout.splitlines()
        self.assertRegex(replayed[0], r"^sessions 1 to 3: verified: \d+ events folded, \d+ rows in \d+ attempts")
        self.assertEqual(len(replayed), 2, replayed)
        listed = self.run_heft("list", "--db", self.db).stdout.splitlines()
        self.assertRegex(listed[0], r"^all: protocol \w+, purpose \w+, state finished$")
        self.assertLessEqual(max(map(len, listed)), 80)
        # A session that differs gets its own line.
        change(self.db, "update trial set outcome = 'none' where session_id = 2")
        replayed = self.run_heft("replay", "--db", self.db, expect=5).stdout
        self.assertRegex(replayed, r"session 1: verified.*\nsession 2: DIVERGED(.*\n)+session 3: verified")


class Witness(Integrity):
    def test_a_head_is_printed_listed_and_confirmed(self):
        done = self.session(self.db, "--backup", self.folder / "copies")
        printed = re.search(r"head of the log: ([0-9a-f]{12})", done.stderr)[1]
        self.assertTrue(self.head().startswith(printed))
        self.assertIn(printed, self.run_heft("list", "--db", self.db).stdout)
        self.assertIn(printed, self.run_heft("show", "--db", self.db).stdout)
        [copy] = (self.folder / "copies").iterdir()
        self.assertIn(printed, copy.name)
        for _ in range(2):
            done = self.run_heft("replay", "--db", self.db, "--witness", printed)
            self.assertIn(f"witness {printed}: confirmed", done.stdout)
            self.session(self.db, "--again")

    def test_another_head_or_no_head_is_refused(self):
        self.people(1)
        done = self.run_heft("replay", "--db", self.db, "--witness", "0" * 12, expect=5)
        self.assertIn("no session of this log ended with the head", done.stderr)
        for text in ("abc", "x" * 12, "A" * 12, "0" * 65):
            self.run_heft("replay", "--db", self.db, "--witness", text, expect=2)

    def test_last_sessions_that_were_removed_are_missed_by_their_head_only(self):
        self.people(2)
        head = self.head()
        for session in (2, 1):
            for table in ("cube", "answer"):
                change(self.db, f"delete from {table} where trial_id in "
                                f"(select trial_id from trial where session_id = {session})")
            for table in ("frame", "event", "reversal", "estimate", "participant_parameter",
                          "participant_info", "trial", "setup", "session", "seal"):
                change(self.db, f"delete from {table} where session_id = {session}")
            self.run_heft("replay", "--db", self.db, expect=0 if session == 2 else 1)
            self.run_heft("replay", "--db", self.db, "--witness", head, expect=5)

    def test_an_interrupted_session_is_sealed_with_the_next(self):
        self.kill_under_way(self.db)
        self.assertEqual(query(self.db, "select count(*) from seal"), [(0,)])
        self.run_heft("replay", "--db", self.db)
        self.run_heft("resume", "--db", self.db)
        self.assertEqual(query(self.db, "select session_id, state from seal"),
                         [(1, "running"), (1, "finished")])
        self.run_heft("replay", "--db", self.db, "--witness", self.head())

    def test_who_ran_a_session_is_in_its_setup(self):
        self.session(self.db, "--operator", "MK")
        self.assertEqual(query(self.db, "select operator from setup"), [("MK",)])
        shutil.copy(TINY, self.folder)
        plan = self.folder / "STUDY.toml"
        plan.write_text('study = "s"\nparticipants = 2\nseed = 1\nprotocol = "tiny.toml"\n'
                        'operator = "of the plan"\ndb = "planned.db"\n')
        self.run_heft("run", "--plan", plan, "--responder", "simulated")
        self.run_heft("run", "--plan", plan, "--responder", "simulated", "--operator", "another")
        self.assertEqual(query(self.folder / "planned.db", "select operator from setup"),
                         [("of the plan",), ("another",)])


class Withdrawal(Integrity):
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
        kept = [f"lab.db.{name}" for name in ("old", "v6", "v7", "v8")]
        for name in kept:
            shutil.copy(self.db, self.folder / name)
        done = self.run_heft("withdraw", "--db", self.db, "--session", 2, "--yes")
        for copy in ("copies/P02_session2", *kept, "data (10 files"):
            self.assertIn(copy, done.stdout)
        listed = self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes").stdout
        # First the copies, because nothing names the person if it is killed afterwards.
        self.assertLess(listed.index("copies, in"), listed.index("session 1 is withdrawn"))
        self.assertIn("copies/P02_session2", listed)  # which has the first session, too

    def test_it_is_neither_done_by_accident_nor_twice(self):
        self.people(1)
        self.run_heft("withdraw", "--db", self.db, expect=2)
        self.run_heft("withdraw", "--db", self.db, "--session", 1, expect=2)  # no --yes
        self.run_heft("withdraw", "--db", self.db, "--session", 9, "--yes", expect=1)
        self.assertEqual(query(self.db, "select state from session"), [("finished",)])
        self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes")
        self.run_heft("withdraw", "--db", self.db, "--session", 1, "--yes", expect=2)

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


class Privacy(Integrity):
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

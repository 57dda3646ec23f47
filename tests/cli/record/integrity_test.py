"""Integrity of logs: no figure from a changed log, heads as witnesses.

Run: python3 tests/cli/record/integrity_test.py PATH_TO_HEFT
"""
import json
import os
import re
import shutil
import sqlite3

from log_harness import SEED, TINY, LogTest
from session_harness import change, main, query

N_CHANGES = int(os.environ.get("HEFT_CHANGES", 40))


class Figures(LogTest):
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

    def test_lists_warn_of_a_changed_log(self):
        self.people(2)
        for command in ("list", "show"):
            self.assertNotIn("WARNING", self.run_heft(command, "--db", self.db).stderr)
        for change_of_log, commands in {
                "update answer set t_s = t_s + 1 where rowid = (select max(rowid) from answer)":
                    ("show",),
                "delete from seal where seal_id = 2": ("list", "show"),
                "create view loot as select 1": ("list", "show")}.items():
            db = self.folder / "changed.db"
            shutil.copy(self.db, db)
            change(db, change_of_log)
            self.refuses(db, change_of_log)
            for command in commands:
                for words in ((), ("--json",)):
                    done = self.run_heft(command, "--db", db, *words)
                    self.assertIn("WARNING", done.stderr, f"{command}: {change_of_log}")

    def test_a_log_without_sessions_has_no_figures(self):
        empty = self.folder / "empty.db"
        empty.touch()
        self.people(1)
        for words in (["analyse", "--db", empty], ["analyse", "--db", empty, "--unverified"],
                      ["analyse", "--db", self.db, "--db", empty],
                      ["export", empty, "--out", self.folder / "refused"]):
            done = self.run_heft(*words, expect=1)
            self.assertEqual(done.stdout, "")
            self.assertIn("empty.db holds no session yet", done.stderr)

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


class Several(LogTest):
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


class Witness(LogTest):
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


if __name__ == "__main__":
    main("__main__")

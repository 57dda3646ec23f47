"""Exports: CSV files hold what SQLite holds, the dictionary explains every column, and analyse's
figures can be computed from them. Psych-DS and BIDS datasets follow the rules of their standards
(validators, R and pandas: export_against_others.py).

Run: python3 tests/cli/export_test.py PATH_TO_HEFT
"""
import csv
import json
import re
import resource
import shutil
import sqlite3
import stat
import subprocess
from statistics import mean, stdev

from session_harness import PROTOCOLS, SessionTest, change, main, query

TABLES = {"trials": "trial", "answers": "answer", "reversals": "reversal", "estimates": "estimate",
          "cubes": "cube", "participants": "session", "setups": "setup", "frames": "frame"}
# Columns of the log that a file omits.
LEFT_OUT = {"participants": {"protocol_text", "run_options", "n_events", "n_frames", "info_digest",
                             "digest"}, "frames": {"digest"}}
# Columns that only CSV files have.
ADDED = {"log", "lab", "participant", "person", "session_id", "response_time_s"}
TASKS = {"introduction", "sorting", "comparison"}


def unescaped(text):
    return text[1:] if text.startswith("'") else text


class Export(SessionTest):
    def simulate(self, name, *words, participants=2, seed=5):
        db = self.folder / name
        self.run_heft("simulate", PROTOCOLS / "quick.toml", "--participants", participants, "--seed",
                      seed, "--db", db, *words)
        return db

    def export(self, *logs, out="data", format="csv", **options):
        return self.run_heft("export", *logs, "--format", format, "--out", self.folder / out,
                             cwd=self.folder, **options)

    def rows(self, file, out="data"):
        with open(self.folder / out / f"{file}.csv", newline="", encoding="utf-8") as lines:
            return list(csv.DictReader(lines))

    def assert_same(self, cell, value, where):
        if value is None:
            self.assertEqual(cell, "", where)
        elif isinstance(value, str):
            self.assertEqual(unescaped(cell), value, where)
        else:
            self.assertEqual(type(value)(cell), value, where)

    def assert_holds(self, db, file, rows):
        table = TABLES[file]
        order = "slot" if table == "cube" else "rowid"
        by_trial = "trial_id, " if table == "cube" else ""
        connection = sqlite3.connect(db)
        connection.row_factory = sqlite3.Row
        logged = connection.execute(f"select * from {table} order by {by_trial}{order}").fetchall()
        connection.close()
        self.assertEqual(len(rows), len(logged), file)
        for row, in_log in zip(rows, logged):
            for column in in_log.keys():
                if column not in LEFT_OUT.get(file, ()):
                    self.assert_same(row[column], in_log[column], (file, column))

    def test_csv_read_back_is_what_sqlite_holds(self):
        db = self.simulate("lab.db", "--frames")
        note = '=HYPERLINK("http://x"), "quoted",\nsecond line'
        for key, value in (("age", "30"), ("=1+1", note), ("=1+1", "'kept")):
            change(db, f"insert or replace into participant_info values (1, '{key}', "
                       f"'{value.replace(chr(39), chr(39) * 2)}')")
        change(db, "update trial set block = '=block', void_reason = '@' where trial_id = 1")
        change(db, "update trial set block = '-5', level_g = -5 where trial_id = 2")
        done = self.export(db, "--unverified")
        self.assertEqual(done.stdout, "")
        self.assertIn("read.csv", done.stderr)
        for file in TABLES:
            with self.subTest(file):
                self.assert_holds(db, file, self.rows(file))
                self.assertIn(f" {len(self.rows(file))} rows  {file}.csv\n", done.stderr)
        trials = self.rows("trials")
        self.assertEqual([trials[0]["block"], trials[0]["void_reason"]], ["'=block", "'@"])
        self.assertEqual([trials[1]["block"], trials[1]["level_g"]], ["'-5", "-5"])
        person = self.rows("participants")[0]
        self.assertEqual([person["info_age"], person["info_=1+1"]], ["30", "''kept"])

    def test_a_participant_has_what_it_was_drawn_as(self):
        db = self.simulate("lab.db", participants=1)
        self.export(db)
        (person,) = self.rows("participants")
        drawn = query(db, "select name, value from participant_parameter")
        self.assertGreater(len(drawn), 20)
        for name, value in drawn:
            self.assertEqual(float(person[f"parameter_{name}"]), value)

    def test_every_column_is_explained_once(self):
        db = self.simulate("lab.db", "--frames", participants=1)
        self.export(db)
        entries = self.rows("dictionary")
        for file, table in TABLES.items():
            columns = list(self.rows(file)[0]) if self.rows(file) else None
            explained = [entry for entry in entries if entry["file"] == f"{file}.csv"]
            if columns is not None:
                self.assertEqual([entry["column"] for entry in explained], columns)
            for entry in explained:
                self.assertNotEqual(entry["meaning"], "", entry)
            names = {entry["column"] for entry in explained}
            in_log = {name for (name,) in query(db, f"select name from pragma_table_info('{table}')")}
            self.assertEqual(in_log - LEFT_OUT.get(file, set()) - names, set(), file)
            for name in names - in_log - ADDED:
                self.assertRegex(name, "^(parameter|info)_", file)
        levels = {(entry["file"], entry["column"]): entry["levels"] for entry in entries}
        # The dictionary has the words of every task; the log those of the tasks that it has trials of.
        self.assertLessEqual({name for (name,) in query(db, "select name from list_task")},
                             set(levels["trials.csv", "task"].split("|")))
        self.assertEqual(levels["trials.csv", "is_catch"], "0|1")
        units = {(entry["file"], entry["column"]): entry["unit"] for entry in entries}
        self.assertEqual(units["frames.csv", "effector_x_m"], "m")
        self.assertEqual(units["cubes.csv", "peak_lag_m"], "m")

    def test_several_logs_are_together_in_the_order_given(self):
        one, other = self.simulate("b.db", participants=1), self.simulate("a.db", seed=6)
        self.export("b.db", "a.db")
        logs = [row["log"] for row in self.rows("participants")]
        self.assertEqual(logs, ["b.db", "a.db", "a.db"])
        self.assertFalse((self.folder / "data" / "frames.csv").exists())
        trials = self.rows("trials")
        self.assert_holds(one, "trials", [row for row in trials if row["log"] == "b.db"])
        self.assert_holds(other, "trials", [row for row in trials if row["log"] == "a.db"])
        self.export("--db", "b.db", "--db", "a.db", out="again")
        for file in (self.folder / "data").iterdir():
            self.assertEqual(file.read_bytes(), (self.folder / "again" / file.name).read_bytes())
        self.assertIn("given twice", self.export("b.db", "./b.db", out="twice", expect=2).stderr)
        shutil.copy(self.folder / "a.db", self.folder / "copy.db")
        self.assertIn("session 1 of a.db and session 1 of copy.db are the same",
                      self.export("a.db", "copy.db", out="twice", expect=2).stderr)
        self.run_heft("analyse", "--db", "a.db", "--db", "copy.db", expect=2, cwd=self.folder)

    def test_people_named_alike_in_two_logs_are_two(self):
        self.simulate("a.db")
        self.simulate("b.db", seed=6)
        self.export("a.db", out="one")
        alone = self.rows("trials", "one")
        self.assertEqual({row["person"] for row in alone}, {"sim-0001", "sim-0002"})
        self.export("a.db", "b.db")
        people = {f"{log}: sim-000{i}" for log in ("a.db", "b.db") for i in (1, 2)}
        for file in (self.folder / "data").glob("*.csv"):
            rows = self.rows(file.stem)
            if file.stem != "dictionary" and rows:
                self.assertLessEqual({row["person"] for row in rows}, people, file)
                self.assertTrue(all(row["person"] == f"{row['log']}: {row['participant']}"
                                    for row in rows), file)
        self.assertEqual({row["person"] for row in self.rows("participants")}, people)
        summary = json.loads(self.run_heft("analyse", "--db", "a.db", "--db", "b.db", "--json", "--mix",
                                           cwd=self.folder).stdout)
        self.assertEqual({row["participant"] for row in summary["participants"]},
                         {f"{person} (simulated)" for person in people})
        self.assertEqual((summary["n_participants"], summary["database"]), (4, "a.db, b.db"))
        apart = [json.loads(self.run_heft("analyse", "--db", db, "--json", cwd=self.folder).stdout)
                 for db in ("a.db", "b.db")]
        of = lambda summary: summary["sorting"]["C2"]["correct"]
        self.assertAlmostEqual(of(summary)["mean"], mean(of(one)["mean"] for one in apart))
        self.assertEqual(of(summary)["n_participants"], 4)
        for file in ("a.db", "./a.db"):
            self.assertIn("given twice", self.run_heft("analyse", "--db", "a.db", "--db", file,
                                                       cwd=self.folder, expect=2).stderr)
        self.assertIn("single log", self.run_heft("analyse", "--db", "a.db", "--db", "b.db",
                                                  "--session", 1, cwd=self.folder, expect=2).stderr)
        script = (self.folder / "data" / "analysis.R").read_text()
        self.assertNotIn("table$participant", script)
        if shutil.which("Rscript"):
            printed = subprocess.run(["Rscript", "analysis.R"], cwd=self.folder / "data", text=True,
                                     capture_output=True, check=True).stdout
            self.assertIn("heft export: 4 participants", printed)
        self.export("a.db", "b.db", format="bids", out="bids")
        self.assertEqual([row["participant_id"] for row in
                          self.table(self.folder / "bids" / "participants.tsv")],
                         ["sub-sim0001", "sub-sim0002", "sub-sim0001x2", "sub-sim0002x2"])

    def test_nothing_is_overwritten(self):
        self.simulate("lab.db", participants=1)
        (self.folder / "data").mkdir()
        self.export("lab.db")
        self.assertIn("never overwrite files", self.export("lab.db", expect=2).stderr)
        (self.folder / "part").mkdir()
        (self.folder / "part" / "export_unfinished.txt").write_text("")
        self.assertIn("unfinished export", self.export("lab.db", out="part", expect=2).stderr)
        self.assertIn("is a file", self.export("lab.db", out="lab.db", expect=2).stderr)
        self.assertIn("no file", self.export("none.db", out="new", expect=1).stderr)
        self.assertFalse((self.folder / "new").exists())

    def test_an_export_that_fails_says_that_it_is_not_whole(self):
        db = self.simulate("lab.db", participants=1)
        change(db, "update trial set block = hex(zeroblob(200000))")

        def small_files_only():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))
        done = self.export(db, "--unverified", expect=1, preexec_fn=small_files_only)
        self.assertIn("cannot write", done.stderr)
        self.assertTrue((self.folder / "data" / "export_unfinished.txt").exists())

    # The figures of analyse, from the files alone.

    def test_sorting_shares_are_those_of_analyse(self):
        db = self.simulate("lab.db", participants=5)
        self.export(db)
        figures = json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)
        self.assertGreater(figures["sorting"]["C2"]["n_trials"], 0)
        for condition in ("C1", "C2"):
            told = figures["sorting"][condition]
            for name, outcome in (("correct", "correct"), ("incorrect", "incorrect"),
                                  ("none", "dont_know")):
                shares = {}
                for row in self.rows("trials"):
                    if (row["task"], row["condition"], row["status"]) == ("sorting", condition,
                                                                          "completed"):
                        shares.setdefault(row["participant"], []).append(row["outcome"] == outcome)
                percents = [100 * mean(hits) for hits in shares.values()]
                if not percents:
                    continue
                self.assertEqual(told[name]["n_hits"], sum(map(sum, shares.values())))
                self.assertAlmostEqual(told[name]["mean"], mean(percents), 9)
                self.assertAlmostEqual(told[name]["sd"], stdev(percents), 9)

    def test_choices_are_what_a_fit_is_made_of(self):
        db = self.simulate("lab.db", participants=3)
        self.export(db)
        choices = self.rows("choices")
        fits = json.loads(self.run_heft("fit", self.folder / "data" / "choices.csv", "--model",
                                        "indecision", "--by", "compared", "--json").stdout)
        self.assertEqual(sum(fit["n_trials"] for fit in fits), len(choices))
        figures = json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)
        self.assertEqual(sum(one["n_trials"] for one in figures["sensitivity"]), len(choices))
        for row in choices:
            level, on_right = float(row["level_g"]), float(row["right_minus_left_g"])
            self.assertEqual(abs(level), abs(on_right))
            self.assertEqual(row["answer"] == "none", row["side"] == "none")
            if row["answer"] != "none" and level:
                self.assertEqual((row["answer"] == "comparison") == (level > 0),
                                 (row["side"] == "right") == (on_right > 0))

    def test_wide_has_a_row_a_completed_trial(self):
        db = self.simulate("lab.db", participants=2)
        change(db, "update trial set status = 'void' where trial_id = 2")
        self.export(db, "--unverified")
        wide = self.rows("wide")
        completed = query(db, "select session_id, trial_number, response_time_s from v_trial where "
                              "status = 'completed' order by trial_id")
        self.assertEqual([(int(row["session"]), int(row["trial"]), float(row["response.rt"]))
                          for row in wide], completed)
        first = [int(row["trials.thisN"]) for row in wide if row["session"] == "1"]
        self.assertEqual(first, list(range(len(first))))

    # Datasets that follow a standard.

    def test_psych_ds_keeps_its_rules(self):
        self.export(self.simulate("lab.db", "--frames"), format="psych-ds")
        data = self.folder / "data" / "data"
        files = sorted(data.iterdir())
        self.assertIn("description-frames_data.csv", [file.name for file in files])
        description = json.loads((self.folder / "data" / "dataset_description.json").read_text())
        self.assertEqual(description["@type"], "Dataset")
        self.assertIn("schema.org", description["@context"])
        explained = [variable["name"] for variable in description["variableMeasured"]]
        self.assertEqual(len(explained), len(set(explained)))
        for variable in description["variableMeasured"]:
            self.assertTrue(variable["description"], variable)
        used = set()
        for file in files:
            self.assertRegex(file.name, r"^([a-z]+-[A-Za-z0-9]+_)+data\.csv$")
            with open(file, newline="", encoding="utf-8") as lines:
                header = next(csv.reader(lines))
            self.assertEqual(len(header), len(set(header)), file)
            used |= set(header)
        self.assertEqual(used, set(explained))

    def test_bids_keeps_its_rules(self):
        db = self.simulate("lab.db", participants=3)
        change(db, "update session set participant = 'Ann B.' where session_id < 3")
        change(db, "update session set participant = 'annb' where session_id = 3")
        self.export(db, "--unverified", format="bids")
        root = self.folder / "data"
        people = self.table(root / "participants.tsv")
        self.assertEqual([row["participant_id"] for row in people], ["sub-AnnB", "sub-annbx2"])
        self.assertEqual([row["n_sessions"] for row in people], ["2", "1"])
        tables = [file for file in root.rglob("*.tsv") if file.parent.name == "beh"]
        name = r"^(sub-[A-Za-z0-9]+)_(ses-[0-9]+)_task-([a-z]+)_(beh|events)\.tsv$"
        n_trials = 0
        for file in tables:
            subject, session, task, suffix = re.match(name, file.name).groups()
            self.assertEqual(file.parent, root / subject / session / "beh")
            sidecar = json.loads((root / f"task-{task}_{suffix}.json").read_text())
            rows = self.table(file)
            self.assertEqual(set(rows[0]) - set(sidecar), set(), file)
            for row in rows:
                self.assertNotIn("", row.values())
                if suffix == "events":
                    float(row["onset"]), float(row["duration"])
            n_trials += len(rows) if suffix == "beh" else 0
        self.assertEqual(n_trials, query(db, "select count(*) from trial")[0][0])

    def table(self, file):
        with open(file, newline="", encoding="utf-8") as lines:
            return list(csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))

    def test_the_key_of_pseudonyms_is_not_given_away(self):
        db = self.folder / "a.db"
        self.session(db)
        shared = self.folder / "deep" / "shared"
        for key in (shared / "k.key", shared / ".." / "shared" / "k.key"):
            said = self.run_heft("export", db, "--pseudonymise", "--key", key, "--out", shared,
                                 expect=2).stderr
            self.assertIn("shared with the folder", said)
            self.assertFalse(shared.exists())
        self.run_heft("export", db, "--pseudonymise", "--out", f"{shared}/")
        self.assertTrue((self.folder / "deep" / "shared.key").exists())

    def test_pseudonyms_leave_no_one_and_nothing_typed(self):
        db = self.simulate("lab.db")
        secrets = {"Ann Person": "update session set participant = 'Ann Person' where session_id = 1",
                   "asked for water": "update trial set status = 'void', void_reason = 'asked for "
                                      "water' where trial_id = 2",
                   "I live in Lyon": "insert into participant_info values (1, 'where', 'I live in "
                                     "Lyon')",
                   "/lab/ann": "update setup set board_file = '/lab/ann/board.toml', responder = "
                                "'simulated:/lab/ann/model.toml'"}
        for sql in secrets.values():
            self.assertEqual(change(db, sql) > 0, True, sql)
        change(db, "insert into participant_info values (1, 'age', '31')")
        started = query(db, "select started_utc from session")[0][0]
        for kind in ("csv", "psych-ds", "bids"):
            with self.subTest(kind):
                out = self.folder / f"{kind}-out"
                done = self.run_heft("export", db, "--unverified", "--format", kind, "--pseudonymise", "--key",
                                     self.folder / "my.key", "--out", out)
                self.assertIn("my.key", done.stderr)
                texts = {file: file.read_text() for file in out.rglob("*") if file.is_file()}
                for secret in [*secrets, started, str(db)]:
                    for file, text in texts.items():
                        self.assertNotIn(secret, text + str(file.relative_to(out)), file)
        mode = stat.S_IMODE((self.folder / "my.key").stat().st_mode)
        self.assertEqual(mode, 0o600)
        one, other = sorted(self.rows("participants", out="csv-out"),
                            key=lambda row: row["info_age"], reverse=True)
        self.assertRegex(one["participant"], "^p[0-9a-f]{12}$")
        self.assertNotEqual(one["participant"], other["participant"])
        self.assertEqual([one["info_age"], one["info_where"], one["responder"]],
                         ["31", "", "simulated"])
        self.assertEqual(one["started_utc"], started[:4])
        self.run_heft("export", db, "--unverified", "--pseudonymise", "--out",
                      self.folder / "again")
        self.assertTrue((self.folder / "again.key").exists())
        again = self.rows("participants", out="again")
        self.assertNotIn(one["participant"], [row["participant"] for row in again])


if __name__ == "__main__":
    main(__name__)

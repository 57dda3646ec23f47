"""Logs as CSV: read back they are what SQLite holds, and the dictionary explains every column.

Run: python3 tests/cli/export_test.py PATH_TO_HEFT
"""
import csv
import sqlite3

from session_harness import PROTOCOLS, SessionTest, change, main, query

TABLES = {"trials": "trial", "answers": "answer", "reversals": "reversal", "estimates": "estimate",
          "cubes": "cube", "participants": "session", "setups": "setup", "frames": "frame"}
# What a file leaves to the log, and what it has beside the table's own columns.
LEFT_OUT = {"participants": {"protocol_text", "run_options", "n_events", "n_frames", "info_digest",
                             "digest"}, "frames": {"digest"}}
# All names that only CSV files have.
ADDED = {"log", "participant", "session_id", "response_time_s"}


def unescaped(text):
    return text[1:] if text.startswith("'") else text


class Export(SessionTest):
    def simulate(self, name, *words, participants=2, seed=5):
        db = self.folder / name
        self.run_heft("simulate", PROTOCOLS / "quick.toml", "--participants", participants, "--seed",
                      seed, "--db", db, *words)
        return db

    def export(self, *logs, out="data", **options):
        return self.run_heft("export", *logs, "--format", "csv", "--out", self.folder / out,
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
        done = self.export(db)
        self.assertEqual(done.stdout, "")
        self.assertIn("read.csv", done.stderr)
        for file in TABLES:
            with self.subTest(file):
                self.assert_holds(db, file, self.rows(file))
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
        self.assertEqual(levels["trials.csv", "task"],
                         "|".join(name for (name,) in query(db, "select name from list_task order "
                                                                "by rowid")))
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

    def test_nothing_is_overwritten(self):
        self.simulate("lab.db", participants=1)
        (self.folder / "data").mkdir()
        self.export("lab.db")
        self.assertIn("nothing is overwritten", self.export("lab.db", expect=2).stderr)
        self.assertIn("is a file", self.export("lab.db", out="lab.db", expect=2).stderr)
        self.assertIn("no file", self.export("none.db", out="new", expect=1).stderr)
        self.assertFalse((self.folder / "new").exists())


if __name__ == "__main__":
    main(__name__)

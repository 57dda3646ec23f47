"""Judgments by a procedure, from end to end: validate, simulate, kill-free log, replay, export, analyse.

Run: python3 tests/cli/analysis/judgment_staircase_test.py PATH_TO_HEFT
"""
import csv
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main, query

EXAMPLE = PROTOCOLS / "examples/judgment_staircase.toml"


class JudgmentStaircase(SessionTest):
    def test_example_is_simulated_replayed_exported_and_analysed(self):
        self.assertIn(": ok,", self.run_heft("validate", EXAMPLE).stdout)
        db = self.folder / "s.db"
        self.run_heft("simulate", EXAMPLE, "--participants", 6, "--seed", 3, "--db", db)
        self.run_heft("replay", "--db", db)  # fails where a row differs
        methods = query(db, "select staircase, reference_g, count(*) from v_jnd group by 1 order by 1")
        self.assertEqual([(row[0], row[1]) for row in methods],
                         [("harder at 200 g", 200), ("heavy", None)])
        # The responses move the staircase: down after "yes" (2nd choice: no), up after "no".
        levels = query(db, "select session_id, level_g, value from trial where staircase = 'heavy' "
                           "and status = 'completed' order by trial_id")
        for (session, level, value), (next_session, next_level, _) in zip(levels, levels[1:]):
            if session == next_session and level > 10:
                self.assertEqual(next_level < level, value == 1, (level, next_level, value))
        self.assertEqual(query(db, "select count(*) from trial where staircase = 'heavy' and "
                                   "level_g != (select mass_g from cube where cube.trial_id = "
                                   "trial.trial_id)")[0][0], 0)

        found = json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)
        thresholds = {row["block"]: row for row in found["judgment_threshold"]}
        self.assertEqual(set(thresholds), {"heavy", "harder"})
        self.assertIsNone(thresholds["heavy"]["reference_g"])
        self.assertEqual(thresholds["harder"]["reference_g"], 200)
        # Upper half of a scale to 100 mm (Judgment.h): 17.9 mm, with the paper's spring 114 g.
        self.assertGreater(thresholds["heavy"]["mean_g"], 80)
        self.assertLess(thresholds["heavy"]["mean_g"], 150)
        self.assertEqual(thresholds["heavy"]["n"], 6)
        self.assertFalse(found.get("jnd"))  # those are of comparisons

        self.run_heft("export", db, "--out", self.folder / "data")
        with open(self.folder / "data/trials.csv", newline="", encoding="utf-8") as lines:
            rows = [row for row in csv.DictReader(lines) if row["staircase"] == "heavy"]
        self.assertTrue(rows)
        self.assertEqual({row["reference_g"] for row in rows}, {""})

    def test_report_says_how_masses_were_set(self):
        db = self.folder / "s.db"
        self.run_heft("simulate", EXAMPLE, "--participants", 2, "--seed", 3, "--db", db)
        self.run_heft("analyse", "--db", db, "--out", self.folder / "report")
        with open(self.folder / "report/staircase_trials.csv", newline="", encoding="utf-8") as lines:
            trials = list(csv.DictReader(lines))
        self.assertEqual({(row["block"], row["question"], row["positive"]) for row in trials},
                         {("heavy", "heavy", "yes"), ("harder", "harder", "left, right")})
        logged = query(db, "select count(*) from trial where status = 'completed'")[0][0]
        self.assertEqual(len(trials), logged)
        page = (self.folder / "report/report.html").read_text(encoding="utf-8")
        self.assertIn("about one cube in C2. The mass was set by an up-down staircase", page)
        self.assertIn("about a reference and a comparison on random sides in C2", page)

    def test_choices_without_a_response_are_refused_at_their_question(self):
        text = EXAMPLE.read_text(encoding="utf-8")
        line = 1 + text[:text.index('"heavy.heavy"')].count("\n")
        wrong = self.folder / "wrong.toml"
        wrong.write_text(text.replace('no = "negative"', 'never = "negative"'), encoding="utf-8")
        said = self.run_heft("validate", wrong, expect=3)
        self.assertIn(f"wrong.toml:{line}:12: block heavy: responses has nothing for the choice \"no\" "
                      'of heavy.heavy, expected "yes" or "no"',
                      said.stdout + said.stderr)
        said = self.run_heft("simulate", wrong, "--db", self.folder / "s.db", expect=3)
        self.assertIn("the choice \"no\"", said.stderr)


if __name__ == "__main__":
    main("__main__")

"""Every figure of heft analyse for fixed simulated studies: JSON and CSV, value by value.

Existing figures must not change; new keys, columns and rows are allowed. Words are not compared.
Run: python3 tests/cli/analyse_golden_test.py PATH_TO_HEFT [--update]
"""
import csv
import json
import math
import sqlite3
import sys
from pathlib import Path

from session_harness import PROTOCOLS, ROOT, SessionTest, main

GOLDEN = ROOT / "tests" / "golden" / "analysis"
# name: what is simulated, in this order, into one log
STUDIES = {
    "paper": [("paper.toml", "simulated", 4, 20261123)],
    "paired_staircases": [("examples/paired_staircases.toml", "simulated", 3, 7), ("jnd.toml", "coin", 2, 3)],
}
# What the program is and where it ran, and lists of single trials.
NOT_FIGURES = {"command", "heft_version", "database", "files"}
LISTS = {"dictionary.csv", "setups.csv", "protocol_choices.csv", "staircase_trials.csv",
         "deviations.csv"}


def rounded(value):
    return float(f"{value:.8g}") if isinstance(value, float) else value


def figures(value):
    """Numbers, nothing, and where they stand."""
    if isinstance(value, dict):
        return {key: figures(one) for key, one in value.items() if key not in NOT_FIGURES}
    if isinstance(value, list):
        return [figures(one) for one in value]
    return rounded(value)


def cell(text):
    try:
        return rounded(float(text))
    except ValueError:
        return text


def columns_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    return {name: [cell(row[i]) for row in rows] for i, name in enumerate(header)}


class AnalyseGolden(SessionTest):
    def analysed(self, name):
        db, out = self.folder / f"{name}.db", self.folder / name
        for protocol, responder, participants, seed in STUDIES[name]:
            self.run_heft("simulate", PROTOCOLS / protocol, "--responder", responder,
                          "--participants", str(participants), "--seed", str(seed), "--db", db)
        self.run_heft("analyse", "--db", db, "--out", out)
        tables = {path.name: columns_of(path) for path in sorted(out.glob("*.csv"))
                  if path.name not in LISTS}
        return {"json": figures(json.loads((out / "summary.json").read_text(encoding="utf-8"))),
                "csv": tables}

    def assert_kept(self, golden, found, place):
        if isinstance(golden, dict):
            self.assertIsInstance(found, dict, place)
            for key, value in golden.items():
                self.assertIn(key, found, place)
                self.assert_kept(value, found[key], f"{place}/{key}")
        elif isinstance(golden, list):
            self.assertIsInstance(found, list, place)
            self.assertEqual(len(golden), len(found), place)
            for i, (one, other) in enumerate(zip(golden, found)):
                self.assert_kept(one, other, f"{place}/{i}")
        elif isinstance(golden, (int, float)) and not isinstance(golden, bool):
            self.assertIsInstance(found, (int, float), place)
            self.assertTrue(math.isclose(golden, found, rel_tol=1e-6, abs_tol=1e-9),
                            f"{place}: {golden} became {found}")
        elif not isinstance(golden, str):
            self.assertEqual(golden, found, place)

    def test_the_papers_mean_is_its_rule(self):
        """Mean level of all reversals but two, then over participants, each of one session."""
        self.analysed("paper")
        log = sqlite3.connect(self.folder / "paper.db")
        by_hand = dict(log.execute("""
            SELECT reference_g, avg(jnd_g) FROM (
              SELECT avg(level_g) AS jnd_g, (SELECT reference_g FROM trial WHERE trial.session_id =
                reversal.session_id AND trial.trial_id = reversal.trial_id) AS reference_g
              FROM reversal WHERE number > 2 GROUP BY session_id, staircase) GROUP BY reference_g"""))
        log.close()
        found = json.loads((self.folder / "paper" / "summary.json").read_text(encoding="utf-8"))
        self.assertEqual({15, 200, 800}, set(by_hand))
        for jnd in found["jnd"]:
            self.assertAlmostEqual(by_hand[jnd["reference_g"]], jnd["paper_mean_g"], places=6)

    def test_figures_are_kept(self):
        for name in STUDIES:
            with self.subTest(study=name):
                path, found = GOLDEN / f"{name}.json", self.analysed(name)
                if update:
                    path.write_text(json.dumps(found, ensure_ascii=False, indent=None,
                                               separators=(",", ":")) + "\n", encoding="utf-8")
                self.assert_kept(json.loads(path.read_text(encoding="utf-8")), found, name)


if __name__ == "__main__":
    update = "--update" in sys.argv
    sys.argv = [word for word in sys.argv if word != "--update"]
    main("__main__")

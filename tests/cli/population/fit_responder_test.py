"""Which simulated people give reported figures or a log's answers: tables, JSON, refusals.

Run: python3 tests/cli/population/fit_responder_test.py PATH_TO_HEFT
"""
import json
import sqlite3
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main

FREE = ["--free", "criterion_mm=1..40", "--people", 100]


class FitResponder(SessionTest):
    def log(self):
        db = self.folder / "log.db"
        self.run_heft("simulate", PROTOCOLS / "quick.toml", "--participants", 3, "--seed", 4,
                      "--level", "surrogate", "--db", db)
        return db

    def test_to_the_answers_of_a_log(self):
        db, saved = self.log(), self.folder / "fitted.toml"
        words = ["fit-responder", "--db", db, *FREE, "--repeats", 20]
        said = self.run_heft(*words, "--save", saved).stdout
        for part in ("by 3 participants", "verified, head", "criterion_mm ", "per answer"):
            self.assertIn(part, said)
        self.assertNotIn("figure", said)
        self.assertNotIn("nan", said)
        found = json.loads(self.run_heft(*words, "--json", "--jobs", 1).stdout)
        again = json.loads(self.run_heft(*words, "--json", "--jobs", 3).stdout)
        self.assertEqual(found, again)
        self.assertEqual(found["figures"], [])
        self.assertLess(found["log_likelihood_fitted"], 0)
        self.run_heft("simulate", PROTOCOLS / "quick.toml", "--responder", f"population:{saved}",
                      "--level", "surrogate", "--db", self.folder / "again.db")

    def test_a_changed_log_gives_no_figures(self):
        db = self.log()
        with sqlite3.connect(db) as log:
            log.execute("update trial set outcome = 'difference' where rowid = "
                        "(select min(rowid) from trial where outcome = 'no_difference')")
        log.close()
        self.run_heft("fit-responder", "--db", db, *FREE, expect=5)

    def test_mistakes_are_refused(self):
        figures = PROTOCOLS / "examples/paper_figures.toml"
        db, paper = self.folder / "none.db", PROTOCOLS / "paper.toml"
        for words in ([paper], ["--figures", figures], ["--db", db, "--figures", figures],
                      [paper, "--db", db], ["--db", db, "--set", "physics.friction=0.5"],
                      [paper, "--figures", figures, "--db", db]):
            self.run_heft("fit-responder", *words, *FREE, expect=2)
        self.run_heft("fit-responder", paper, "--figures", figures, expect=2)
        self.run_heft("fit-responder", "--db", db, *FREE, expect=1)


if __name__ == "__main__":
    main("__main__")

"""Logs of simulated people, for tests that change, withdraw or export them."""
import csv
import os
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import ROOT, SessionTest, query

TINY = ROOT / "tests" / "golden" / "logs" / "tiny.toml"
SEED = int(os.environ.get("HEFT_SEED", random.randrange(10**9)))


class LogTest(SessionTest):
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

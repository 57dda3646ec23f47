"""Logs of several labs in one analysis and one export, and the methods in the report.

Run: python3 tests/cli/analysis/labs_test.py PATH_TO_HEFT
"""
import csv
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main


class Labs(SessionTest):
    def simulate(self, protocol, lab, seed, *words, participants=6):
        self.run_heft("simulate", PROTOCOLS / protocol, "--participants", participants, "--seed", seed,
                      "--db", f"{lab}.db", *words, cwd=self.folder)

    def rows(self, file):
        with open(self.folder / file, newline="", encoding="utf-8") as lines:
            return list(csv.DictReader(lines))

    def test_each_lab_has_its_thresholds(self):
        for seed, lab in enumerate(("lyon", "zurich")):
            self.simulate("examples/paired_staircases.toml", lab, seed + 1)
        logs = ["--db", "lyon.db", "--db", "zurich.db"]
        self.run_heft("analyse", *logs, "--out", "report", cwd=self.folder)
        labs = self.rows("report/labs.csv")
        self.assertEqual({row["lab"] for row in labs}, {"lyon", "zurich"})
        self.assertEqual({row["n"] for row in labs}, {"6"})
        for lab in ("lyon", "zurich"):
            self.run_heft("analyse", "--db", f"{lab}.db", "--out", lab, cwd=self.folder)
            self.assertFalse((self.folder / lab / "labs.csv").exists())
            alone = {row["reference_g"]: row for row in self.rows(f"{lab}/sensitivity.csv")}
            for row in labs:
                if row["lab"] == lab:
                    for name in ("threshold_75_g", "low_g", "high_g"):
                        self.assertEqual(row[name], alone[row["reference_g"]][name])
        both = {row["reference_g"]: {} for row in labs if row["threshold_75_g"]}
        for row in labs:
            if row["threshold_75_g"]:
                both[row["reference_g"]][row["lab"]] = float(row["threshold_75_g"])
        ratios = self.rows("report/lab_ratios.csv")
        self.assertEqual(len(ratios), sum(len(one) == 2 for one in both.values()))
        self.assertGreater(len(ratios), 0)
        for row in ratios:
            of = both[row["reference_g"]]
            self.assertAlmostEqual(float(row["ratio"]), of["zurich"] / of["lyon"], places=4)
        page = (self.folder / "report" / "report.html").read_text(encoding="utf-8")
        self.assertIn("Differences between labs", page)
        self.run_heft("export", "lyon.db", "zurich.db", "--out", "data", cwd=self.folder)
        for file in ("trials", "choices", "participants", "wide"):
            self.assertTrue(all(f"{row['lab']}.db" == row["log"] for row in self.rows(f"data/{file}.csv")))

    def test_methods_have_the_numbers_of_the_study(self):
        self.simulate("paper.toml", "paper", 1, "--set", "coupling.stiffness_n_per_m=60")
        self.simulate("examples/forced_choice.toml", "forced", 2, participants=3)
        for lab, parts in {
                "paper": ["6 simulated participants", "spring of 60 N/m", "at 15 Hz", "(boxes at 240 Hz)",
                          "800 g from 700 g, steps 200 g", "after 10 reversals", "but the first 2",
                          "Levitt, H. (1971)", "60 sorting"],
                "forced": ["3 simulated participants", "each 4 times", "steps 80, 40, 20 g",
                           "2 % of the answers wrong"]}.items():
            self.run_heft("analyse", "--db", f"{lab}.db", "--out", lab, cwd=self.folder)
            page = (self.folder / lab / "report.html").read_text(encoding="utf-8")
            methods = re.search('<h2 id="methods">.*?</ul>', page, re.S).group()
            n = json.loads((self.folder / lab / "summary.json").read_text(encoding="utf-8"))
            n = sum(row["n_completed"] for row in n["participants"])
            for part in [*parts, f"{n} trials completed"]:
                self.assertIn(part, methods)


if __name__ == "__main__":
    main("__main__")

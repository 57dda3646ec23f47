"""The spring or technique for a range of masses: table, snippet, JSON, chart, refusals of heft tune.

Run: python3 tests/cli/population/tune_test.py PATH_TO_HEFT
"""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import SessionTest, main

RATIO = ('title = "ratio"\n[[technique]]\nname = "ratio"\nkind = "gain"\n'
         'gain_of_mass = [[10, 0.99], [1000, 0.05]]\n'
         '[[block]]\nkind = "sorting"\nname = "s"\nmasses_g = [50, 200]\ntrials = { ratio = 1 }\n')


class Tune(SessionTest):
    def tuned(self, *words):
        return json.loads(self.run_heft("tune", *words, "--repeats", 15, "--json").stdout)

    def test_the_best_spring_becomes_a_snippet(self):
        chart = self.folder / "tune.svg"
        words = ["tune", "--range", "100g..400g", "--repeats", 15, "--chart", chart]
        said = self.run_heft(*words).stdout
        lines = said.splitlines()
        self.assertLessEqual(max(map(len, lines)), 80)
        self.assertIn("[coupling]\nstiffness_n_per_m = ", said)
        self.assertIn("by whole sessions", said)
        self.assertIn("(best)", chart.read_text(encoding="utf-8"))
        stiffness = next(line.split()[2] for line in lines if line.startswith("stiffness_n_per_m"))
        found = self.tuned("--range", "100g..400g")
        self.assertEqual(found["best"], f"spring {stiffness} N/m")
        self.assertEqual(self.tuned("--range", "100g..400g", "--jobs", 1), found)
        worst = {one["technique"]: one["worst"] for one in found["techniques"]}
        self.assertEqual(min(worst, key=lambda name: worst[name] or 1e9), found["best"])
        self.assertLess(abs(found["whole"]["worst"] / worst[found["best"]] - 1), 0.4)

    def test_heavier_masses_want_stiffer_springs(self):
        def best(low, high):
            return float(self.tuned("--range", f"{low}..{high}")["best"].split()[1])
        self.assertLess(best(10, 30), best(500, 1000))

    def test_a_declared_technique_is_tried_too(self):
        protocol = self.folder / "ratio.toml"
        protocol.write_text(RATIO)
        found = self.tuned(protocol, "--range", "30g..600g", "--stiffness", "900..1000")
        self.assertEqual(found["techniques"][-1]["technique"], "ratio")
        self.assertEqual(found["best"], "ratio")
        said = self.run_heft("tune", protocol, "--range", "30g..600g", "--stiffness", "900..1000",
                             "--repeats", 30).stdout
        self.assertIn('condition = "ratio"', said)

    def test_where_none_serves_it_says_so(self):
        found = self.tuned("--range", "1g..5000g", "--stiffness", "10..20", "--responder", "coin")
        self.assertIsNone(found["best"])
        self.assertIsNone(found["whole"])
        said = self.run_heft("tune", "--range", "1g..5000g", "--repeats", 10, "--responder",
                             "coin").stdout
        self.assertIn("No technique has a threshold at every mass", said)

    def test_mistakes_are_refused(self):
        for words in ([], ["--range", "10g"], ["--range", "10..x"], ["--range", "20g..10g"],
                      ["--range", "0..10"], ["--range", "1..2", "--stiffness", "5"],
                      ["--range", "1..2", "--chart", "a.png"],
                      ["--range", "1..2", "--repeats", "1"]):
            self.run_heft("tune", *words, expect=2)


if __name__ == "__main__":
    main("__main__")

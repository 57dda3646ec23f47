"""What a study can find: tables, JSON, chart, and refusals of heft power.

Run: python3 tests/cli/population/power_test.py PATH_TO_HEFT
"""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main

SHORT = ["power", PROTOCOLS / "quick.toml", "--studies", 3, "--participants", "2,4", "--seed", 7]


class Power(SessionTest):
    def test_the_first_screen_is_a_screen(self):
        chart = self.folder / "power.svg"
        said = self.run_heft("power", PROTOCOLS / "paper.toml", "--studies", 2, "--participants",
                             "2,3,4,5", "--seed", 7, "--chart", chart).stdout
        lines = said.splitlines()
        self.assertLessEqual(len(lines), 25)
        self.assertLessEqual(max(map(len, lines)), 80)
        for words in ("2 simulated studies", "E2-H1", "threshold C2 200 g", "--tables", "5 people"):
            self.assertIn(words, said)
        drawn = chart.read_text(encoding="utf-8")
        for words in "E1-H2", "participants in the study", "JND C2 200 g", "seed 7":
            self.assertIn(words, drawn)
        self.assertEqual([p.name for p in self.folder.glob("power*")], ["power.svg"])

    def test_the_first_screen_has_the_figures_of_every_task(self):
        for name, figure in (("judgment", "mean answer, judgment C2, pairs, heaviness, 50, 100"),
                             ("judgment_staircase", "threshold of judgments, judgment C2, heavy"),
                             ("estimation", "exponent, estimation C2"),
                             ("adjustment", "bias in percent, adjustment C2 100 g"),
                             ("forced_choice", "75 % threshold C2 200 g"),
                             ("same_different", "75 % threshold C2 200 g")):
            said = self.run_heft("power", PROTOCOLS / f"examples/{name}.toml", "--studies", 2,
                                 "--participants", "3", "--seed", 7).stdout
            self.assertIn(f"\n{figure}", said)
            self.assertLessEqual(max(map(len, said.splitlines())), 80)

    def test_a_chart_of_figures_alone_names_them_and_has_no_empty_panel(self):
        chart = self.folder / "power.svg"
        said = self.run_heft("power", PROTOCOLS / "examples/judgment_staircase.toml", "--studies", 2,
                             "--participants", "3", "--seed", 7, "--chart", chart)
        self.assertNotIn("warning", said.stderr)
        drawn = chart.read_text(encoding="utf-8")
        self.assertIn("threshold of judgments, judgment C2, heavy", drawn)
        self.assertNotIn("studies that support it", drawn)

    def test_models_stand_in_json(self):
        words = [*SHORT, "--model", "simulated", "--model", "coin", "--json"]
        found = json.loads(self.run_heft(*words).stdout)
        self.assertEqual(json.loads(self.run_heft(*words, "--jobs", 1).stdout), found)
        simulated, coin = found["models"]
        self.assertEqual((simulated["model"], coin["model"], coin["seed"]), ("simulated", "coin", 7))
        for model in found["models"]:
            self.assertEqual([size["participants"] for size in model["sizes"]], [2, 4])
            for size in model["sizes"]:
                for one in size["hypotheses"]:
                    low, high = one["supported_interval"]
                    self.assertTrue(0 <= low <= one["supported"] <= high <= 1)
                    self.assertAlmostEqual(one["supported"] + one["not_supported"] +
                                           one["inconclusive"], 1)

        def correct(model):
            return next(one["value"] for one in model["sizes"][1]["estimates"]
                        if one["measure"] == "sorting_equivalence" and one["condition"] == "C2")
        self.assertGreater(correct(simulated), 90)
        self.assertLess(correct(coin), 60)

    def test_a_size_is_confirmed_by_whole_sessions(self):
        words = [*SHORT, "--confirm", 4]
        said = self.run_heft(*words).stdout
        self.assertIn("4 people             4 whole", said)
        self.assertIn("whole: the same studies by whole sessions", said)
        sizes = json.loads(self.run_heft(*words, "--json").stdout)["models"][0]["sizes"]
        self.assertEqual([(size["participants"], size["level"]) for size in sizes],
                         [(2, "surrogate"), (4, "surrogate"), (4, "hand")])
        whole = json.loads(self.run_heft(*SHORT, "--level", "hand", "--json").stdout)
        self.assertEqual(whole["models"][0]["sizes"][1], sizes[2])

    def test_a_plan_is_its_protocols_at_the_planned_sizes(self):
        plan = self.folder / "STUDY.toml"
        plan.write_text("\n".join([
            'study = "two protocols"', "participants = 6", "seed = 1",
            *(f'[[group]]\nname = "{name}"\nprotocol = "{PROTOCOLS / file}"'
              for name, file in (("a", "quick.toml"), ("b", "jnd.toml"), ("c", "quick.toml")))]))
        words = ["power", plan, "--studies", 2, "--seed", 7, "--json"]
        models = json.loads(self.run_heft(*words).stdout)["models"]
        self.assertEqual({model["protocol"]: [size["participants"] for size in model["sizes"]]
                          for model in models}, {"jnd": [2], "quick": [4]})
        sized = json.loads(self.run_heft(*words, "--participants", "3").stdout)["models"]
        self.assertEqual([model["sizes"][0]["participants"] for model in sized], [3, 3])
        chart = self.run_heft(*words[:-1], "--chart", "a.svg", expect=2).stderr
        self.assertIn("one protocol", chart)

    def test_mistakes_are_refused(self):
        for words in (["--participants", "2,,4"], ["--participants", "0"], ["--participants", "x"],
                      ["--participants", "2,"], ["--studies", "1"], ["--confirm", "5"],
                      ["--participants", "4", "--confirm", "4", "--level", "hand"],
                      ["--level", "camera"], ["--model", "human"],
                      ["--model", "simulatd"], ["--chart", "a.png"], ["--json", "--tables"],
                      ["--model", "coin", "--model", "simulated", "--chart", "a.svg"]):
            self.run_heft("power", PROTOCOLS / "quick.toml", *words, expect=2)
        self.run_heft("power", self.folder / "missing.toml", expect=1)


if __name__ == "__main__":
    main("__main__")

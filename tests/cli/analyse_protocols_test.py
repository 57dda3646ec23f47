"""Reports of protocols that are not shipped are complete: each completed trial is counted, and every
table and chart names every condition of its task.

Run: python3 tests/cli/analyse_protocols_test.py PATH_TO_HEFT
"""
import json
import os
from pathlib import Path

from session_harness import SessionTest, main, query

SOFT = '[[technique]]\nname = "soft"\nkind = "spring"\nstiffness_n_per_m = 25\n'
RATIO = ('[[technique]]\nname = "C2"\nkind = "gain"\n'
         'gain_of_mass = [[15, 0.95], [200, 0.6], [800, 0.2]]\n')


def sorting(masses, **trials):
    counts = ", ".join(f"{name} = {n}" for name, n in trials.items())
    return (f'[[block]]\nkind = "sorting"\nname = "sorting"\nmasses_g = {masses}\n'
            f"trials = {{ {counts} }}\n")


def introduction(condition):
    return ('[[block]]\nkind = "introduction"\nname = "introduction"\nmasses_g = [15, 800]\n'
            f'condition = "{condition}"\n')


def staircase(condition, reference=200, start=400):
    return (f'[[block.staircase]]\nname = "{reference} {condition}"\nreference_g = {reference}\n'
            f'condition = "{condition}"\nstart = {start}\nstep = 100\nfloor = 0\n'
            "stop_reversals = 4\nstop_trials = 12\ndiscard_reversals = 1\n")


def constant(condition, reference=200):
    return (f'[[block.staircase]]\nname = "constant {condition}"\nkind = "constant"\n'
            f'reference_g = {reference}\ncondition = "{condition}"\n'
            "levels = [-100, 0, 80, 300, 600]\nn_per_level = 2\n")


def comparison(*staircases):
    return ('[[block]]\nkind = "comparison"\nname = "comparison"\ncatch_fraction = 0.1\n'
            + "".join(staircases))


def estimation(low, **trials):
    counts = ", ".join(f"{name} = {n}" for name, n in trials.items())
    return ('[[block]]\nkind = "estimation"\nname = "estimation"\nmasses_g = [50, 200, 800]\n'
            f"trials = {{ {counts} }}\nscale = \"number\"\nlow = {low}\nhigh = 500\n")


def judgment(name, masses, cubes, question, **trials):
    counts = ", ".join(f"{one} = {n}" for one, n in trials.items())
    return (f'[[block]]\nkind = "judgment"\nname = "{name}"\nmasses_g = {masses}\ncubes = {cubes}\n'
            f'trials = {{ {counts} }}\nquestion = "{question}"\n')


def adjustment(**trials):
    counts = ", ".join(f"{one} = {n}" for one, n in trials.items())
    return ('[[block]]\nkind = "adjustment"\nname = "adjustment"\nreference_g = [100, 300]\n'
            f"start_g = [50, 400]\nsteps_g = [80, 20]\ntrials = {{ {counts} }}\n")


def practiced(block):
    head, keys = block.split("name = ", 1)
    return f"{head}practice = {{ trials = 3, until_correct = 2, feedback = true }}\nname = {keys}"


PROTOCOLS = {
    "two cubes": sorting([100, 400], C1=3, C2=3),
    "four cubes": sorting([15, 100, 250, 800], C1=2, C2=2),
    "three techniques": SOFT + introduction("C2") + sorting([15, 200, 800], C1=3, C2=3, soft=3)
    + comparison(staircase("C2"), staircase("soft"), staircase("C1")),
    "one technique of its own": SOFT + introduction("soft") + sorting([15, 200, 800], soft=4)
    + comparison(staircase("soft")),
    "another law called C2": RATIO + introduction("C2") + sorting([15, 200, 800], C1=2, C2=4)
    + comparison(staircase("C2")),
    "constant stimuli": comparison(constant("C2")),
    "a mix": SOFT + sorting([100, 400], C2=2, soft=2)
    + comparison(constant("soft"), staircase("C2", 15, 175), staircase("soft", 800, 700)),
    "no comparison": introduction("C2") + sorting([15, 200, 800], C1=2, C2=2),
    "estimation": SOFT + estimation(0, C2=2, soft=2),
    "judgments": SOFT
    + judgment("pairs", [100, 100, 400], 2, "dissimilarity.heaviness", C2=1, soft=1)
    + judgment("singles", [100, 400], 1, "borg_cr10.exertion", C2=2)
    + judgment("words", [100, 800], 2, "own.which", C2=2),
    "adjustments": SOFT + adjustment(C2=2, soft=1),
    "practice": practiced(sorting([100, 400], C2=3)) + practiced(comparison(staircase("C2"))),
    "no sorting": introduction("C2") + comparison(staircase("C2")),
}
# Charts and tables that name the conditions of a task, where there is something to show.
OF_SORTING = {"sorting", "sorting_by_participant", "sorting_confusion", "sorting_chance", "swapped"}
OF_COMPARISONS = {"choice_curves", "choices", "choices_by_level", "hits_and_false_alarms",
                  "sensitivity", "times_by_level", "thresholds_by_participant"}
OF_STAIRCASES = {"jnd", "staircase_health", "staircases", "jnd_against_start", "staircase_trials"}
OF_ESTIMATION = {"estimation", "estimation_exponent", "estimation_by_participant"}
OF_JUDGMENTS = {"judgment", "judgment_by_participant"}
OF_ADJUSTMENTS = {"adjustment", "adjustment_by_participant"}
WHICH = """[questionnaire.own]
title = "Own"
[[questionnaire.own.question]]
key = "which"
kind = "choice"
text = "Which one is heavier?"
choice = [{ value = "left", text = "Left" }, { value = "right", text = "Right" }]
"""
OF_PAPER = {"C1", "C2"}


class Protocols(SessionTest):
    def study(self, name):
        folder = self.folder / name.replace(" ", "_")
        folder.mkdir()
        protocol, db, out = folder / "p.toml", folder / "s.db", folder / "report"
        protocol.write_text(f'title = "{name}"\n' + PROTOCOLS[name])
        (folder / "own.en.toml").write_text(WHICH)
        self.run_heft("simulate", protocol, "--participants", "3", "--seed", "11", "--db", db)
        self.run_heft("analyse", "--db", db, "--out", out)
        found = json.loads((out / "summary.json").read_text())
        trials = query(db, "select task, condition, staircase, count(*) from trial where "
                           "status = 'completed' and not is_practice group by task, condition, staircase")
        practice = query(db, "select task, count(*), min(level_g), max(staircase) from trial where "
                             "is_practice group by task")
        self.assertEqual(found["participant_flow"]["n_practice_trials"],
                         sum(n for _, n, *_ in practice))
        self.assertEqual({task for task, *_ in practice},
                         {"sorting", "comparison"} if name == "practice" else set())
        for task, n, level_g, procedure in practice:
            self.assertTrue(3 * 2 <= n <= 3 * 3, (task, n))
            self.assertEqual((level_g, procedure),
                             (400, None) if task == "comparison" else (None, None))
        return found, out, trials

    def screen(self, *words):
        """What heft analyse prints by default, checked for its size and its parts."""
        done = self.run_heft("analyse", *words)
        lines = (done.stdout + done.stderr).splitlines()
        self.assertLessEqual(len(lines), 25, done.stdout)
        self.assertLessEqual(max(map(len, lines)), 80, done.stdout)
        self.assertNotIn("nan", done.stdout)
        return " ".join(done.stdout.split())

    def simulated(self, name, protocol, participants=1, seed=5):
        path, db = Path(f"{name}.toml"), f"{name}.db"
        (self.folder / path).write_text(f'title = "{name}"\n' + protocol)
        self.run_heft("simulate", path, "--participants", participants, "--seed", seed, "--db", db,
                      cwd=self.folder)
        return db

    def assert_counted(self, found, trials):
        def completed(task, condition=None):
            return sum(n for of, at, _, n in trials if of == task and condition in (None, at))
        for condition in {at for task, at, _, _ in trials if task == "sorting"}:
            sorted_in = found["sorting"][condition]
            self.assertEqual(sorted_in["n_trials"], completed("sorting", condition))
        self.assertEqual(sum(row["n_trials"] for row in found["comparison"]["by_reference"]),
                         completed("comparison"))
        self.assertEqual(found["introduction"]["n_participants"] or 0, completed("introduction"))
        self.assertEqual(sum(row["n_trials"] for row in found["estimation"]),
                         completed("estimation"))
        for row in found["estimation"]:
            self.assertLess(0, row["low"], row)
            self.assertLess(row["low"], row["geometric_mean"])
            self.assertLess(row["geometric_mean"], row["high"])
        answered = {(row["block"], row["condition"], row["masses_g"]): row["n_trials"]
                    for row in found["judgment"] + found["judgment_choices"]}
        self.assertEqual(sum(answered.values()), completed("judgment"))
        self.assertEqual(sum(row["n_chosen"] for row in found["judgment_choices"]),
                         sum(n for (block, *_), n in answered.items() if block == "words"))
        self.assertEqual(sum(row["n_trials"] for row in found["adjustment"]),
                         completed("adjustment"))
        for row in found["adjustment"]:
            self.assertLess(row["low_percent"], row["bias_percent"], row)
            self.assertLess(row["bias_percent"], row["high_percent"], row)
            self.assertEqual(row["spread_g"] is None, row["condition"] == "soft", row)
        self.assertEqual(sum(row["n_trials"] for row in found["response_times"]),
                         sum(n for *_, n in trials))
        self.assertEqual(sum(row["n_attempts"] - row["n_void"] for row in
                             found["quality"]["losses"]), sum(n for *_, n in trials))

    def assert_named(self, out, names, conditions):
        for name in names:
            for path in (out / f"{name}.csv", out / f"{name}.gp"):
                for condition in conditions if path.exists() else []:
                    self.assertIn(condition.lower(), path.read_text(encoding="utf-8").lower(),
                                  path.name)

    def test_reports_are_complete(self):
        for name in PROTOCOLS:
            with self.subTest(protocol=name):
                found, out, trials = self.study(name)
                self.assert_counted(found, trials)
                of = lambda task: {at for one, at, _, _ in trials if one == task}
                self.assert_named(out, OF_SORTING, of("sorting"))
                self.assert_named(out, OF_COMPARISONS, of("comparison"))
                self.assert_named(out, OF_ESTIMATION, of("estimation"))
                self.assert_named(out, OF_JUDGMENTS, of("judgment"))
                self.assert_named(out, OF_ADJUSTMENTS, of("adjustment"))
                self.assert_named(out, OF_STAIRCASES, {
                    at for task, at, staircase, _ in trials
                    if task == "comparison" and (staircase or "")[:1].isdigit()})
                self.assertNotIn("nan", (out / "estimates.csv").read_text().lower())
                for path in out.glob("*.svg"):
                    self.assertIn("</svg>", path.read_text(encoding="utf-8"), path.name)

    def test_the_first_screen_covers_each_task(self):
        expected = {"sorting": "Sorting: ", "comparison": "Comparisons: ",
                    "introduction": "Introduction: ", "estimation": "Magnitude estimation: ",
                    "judgment": "Judgment ", "adjustment": "Adjustment: "}
        (self.folder / "own.en.toml").write_text(WHICH)
        os.chdir(self.folder)
        for name, protocol in PROTOCOLS.items():
            for participants in (1, 6):
                with self.subTest(protocol=name, participants=participants):
                    key = f"{name.replace(' ', '_')}_{participants}"
                    db = self.simulated(key, protocol, participants)
                    screen = self.screen("--db", db)
                    tasks = {task for [task] in query(self.folder / db, "select task from trial")}
                    for task in tasks:
                        n = query(self.folder / db, "select count(*) from trial where status = "
                                                    f"'completed' and not is_practice and task = '{task}'")[0][0]
                        self.assertIn(f"{n} {task}", screen)
                    shown = [expected[task] in screen for task in tasks]
                    self.assertTrue(all(shown) or "more: see the tables" in screen, screen)
                    for part in ("Results (95 % intervals in brackets)", "Attention", "Next",
                                 "nothing here is about people", f"heft analyse --db {db} --tables"):
                        self.assertIn(part, screen)
                    self.assertNotIn("decoupling (soft)", screen)

    def test_the_first_screen_of_a_report_names_it(self):
        os.chdir(self.folder)
        db = self.simulated("report", PROTOCOLS["three techniques"], 3)
        self.assertIn("Report: out/report.html", self.screen("--db", db, "--out", "out"))

    def test_the_first_screen_of_several_logs_and_of_none(self):
        os.chdir(self.folder)
        logs = [self.simulated(f"lab{i}", PROTOCOLS["two cubes"], seed=i) for i in range(1, 4)]
        screen = self.screen(*(word for db in logs for word in ("--db", db)))
        self.assertIn("3 sessions of 3 participants", screen)
        self.assertIn("were correct", screen)

    def test_the_first_screen_is_the_same_size_for_many_conditions(self):
        os.chdir(self.folder)
        names = [f"stiffness{i}" for i in range(12)]
        techniques = "".join(f'[[technique]]\nname = "{name}"\nkind = "spring"\n'
                             f"stiffness_n_per_m = {20 + i}\n" for i, name in enumerate(names))
        db = self.simulated("many", techniques + sorting([100, 400], **dict.fromkeys(names, 1))
                            + comparison(*(staircase(name) for name in names)))
        screen = self.screen("--db", db)
        self.assertIn("8 more conditions in the tables", screen)

    def test_the_first_screen_without_decoupling_says_so(self):
        os.chdir(self.folder)
        db = self.simulated("other_law", PROTOCOLS["another law called C2"])
        screen = self.screen("--db", db)
        self.assertIn("without decoupling (C1)", screen)
        self.assertNotIn("decoupling (C2)", screen, "its law is not the paper's")

    def test_the_papers_figures_stand_beside_its_techniques_alone(self):
        for name, conditions in [("another law called C2", {"C1"}),
                                 ("one technique of its own", set()), ("two cubes", set()),
                                 ("no comparison", OF_PAPER)]:
            with self.subTest(protocol=name):
                found, out, _ = self.study(name)
                self.assertEqual({condition for condition, of in found["sorting"].items()
                                  if of["correct"]["published"] is not None}, conditions)
                self.assertEqual(found["hypotheses"]["E1-H2"]["verdict"] in
                                 ("supported", "not supported"), "C2" in conditions)
                for row in found["jnd"]:
                    self.assertIsNone(row["published_g"])

    def test_chance_is_of_the_cubes(self):
        for name, chance in [("two cubes", 50), ("four cubes", 100 / 24)]:
            with self.subTest(protocol=name):
                found, out, _ = self.study(name)
                self.assertAlmostEqual(found["sorting"]["C2"]["chance"], chance)
                for chart in ("sorting.gp", "sorting_by_participant.gp"):
                    self.assertIn(f"({chance:.1f} %)", (out / chart).read_text(encoding="utf-8"))


if __name__ == "__main__":
    main("__main__")

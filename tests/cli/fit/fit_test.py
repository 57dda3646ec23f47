"""heft fit: against other programs' figures, and what it reads, prints and refuses.

Run: python3 tests/cli/fit/fit_test.py PATH_TO_HEFT
"""
import json
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import fit_harness
from fit_harness import choice_differences, differences, fits, interval_differences, run

PROTOCOLS = Path(__file__).resolve().parents[3] / "protocols"
GOLDEN = Path(__file__).resolve().parents[2] / "golden" / "fit"
RISING = "x,n_positive,n\n1,2,20\n2,5,20\n3,9,20\n4,15,20\n5,19,20\n"
PSYCHOMETRIC = ["--model", "psychometric"]
INDECISION = ["--model", "indecision"]


class Golden(unittest.TestCase):
    def test_psychometric_functions_as_scipy_finds_them(self):
        n_thresholds = 0
        for case in json.loads((GOLDEN / "psychometric.json").read_text()):
            found = {fit["group"]: fit for fit in fits(GOLDEN / case["file"], *case["arguments"])}
            self.assertEqual(found.keys(), case["fits"].keys())
            for name, expected in case["fits"].items():
                with self.subTest(file=case["file"], dataset=name):
                    self.assertEqual(differences(found[name], expected), [])
                    self.assertEqual(
                        interval_differences(found[name], expected.get("interval", {})), [])
                n_thresholds += found[name]["identifiable"]
        self.assertGreater(n_thresholds, 55)

    def test_indecision_as_clm_finds_it(self):
        golden = json.loads((GOLDEN / "indecision.json").read_text())
        found = fits(GOLDEN / "indecision.csv", *INDECISION, "--by", "dataset")
        self.assertEqual({fit["group"] for fit in found}, golden.keys())
        for fit in found:
            with self.subTest(dataset=fit["group"]):
                self.assertEqual(choice_differences(fit, golden[fit["group"]]), [])


class Fit(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.data = Path(self.folder.name) / "data.csv"

    def run_on(self, text, *words):
        self.data.write_bytes(text.encode("utf-8"))
        done = run(self.data, *words)
        return done.returncode, done.stdout.decode(), done.stderr.decode()

    def fits_of(self, text, *words):
        self.data.write_bytes(text.encode("utf-8"))
        return fits(self.data, *words)

    def test_people_who_are_pooled_are_warned_of(self):
        trials = [f"{level},{int(level > 2 + person)},P{person},{'ab'[person]}"
                  for level in range(1, 6) for person in (0, 1) for _ in range(3)]
        for column in ("participant", "person"):
            data = f"x,response,{column},room\n" + "\n".join(trials) + "\n"
            _, _, message = self.run_on(data, *PSYCHOMETRIC)
            self.assertIn("warning: trials of 2 people are pooled", message)
            for group in (column, "room"):  # each of one person
                self.assertEqual(self.run_on(data, *PSYCHOMETRIC, "--by", group)[2], "")
        self.assertEqual(self.run_on(RISING, *PSYCHOMETRIC)[2], "")

    def test_people_are_fitted_as_analyse_fits_them(self):
        log = Path(self.folder.name) / "log.db"
        subprocess.run([fit_harness.program, "simulate", PROTOCOLS / "paper.toml", "--db", log,
                        "--participants", "7", "--seed", "5"], check=True, capture_output=True)
        analysis = json.loads(subprocess.run([fit_harness.program, "analyse", "--db", log, "--json"],
                                             check=True, capture_output=True).stdout)
        rows = sqlite3.connect(log).execute(
            "select participant, reference_g, level_g, reference_slot, chosen_slot from trial "
            "join session using (session_id) where task = 'comparison' and status = 'completed' "
            "and not is_practice order by trial_id").fetchall()
        # Heavier on the right is above 0.
        text = "who,reference_g,level_g,answer\n" + "".join(
            f"{who},{reference:g},{level if on == 1 else -level},"
            f"{ {None: 'none', 1: 'reference', 2: 'comparison'}[chosen]}\n"
            for who, reference, level, on, chosen in rows)
        found = self.fits_of(text, *INDECISION, "--person", "who", "--by", "reference_g")
        self.assertEqual(len(found), 3)
        n_thresholds = n_people = 0
        for fit in found:
            (row,) = [one for one in analysis["sensitivity"]
                      if f"{one['reference_g']:g}" == fit["group"]]
            self.assertEqual((fit["identifiable"], fit["why"], fit["n_trials"]),
                             (row["identifiable"], row["why"], row["n_trials"]))
            for name, prefix in (("threshold_75_g", ""), ("lapse", "lapse_rate_"),
                                 ("indecision", "indecision_")):
                figure = fit["parameters"][name]
                expected = row.get({"lapse": "lapse_rate"}.get(name, name))
                for value, same in ((figure["value"], expected),
                                    (figure["low"], row.get(f"{prefix}low" if prefix else "low_g")),
                                    (figure["high"],
                                     row.get(f"{prefix}high" if prefix else "high_g"))):
                    with self.subTest(group=fit["group"], name=name):
                        self.assertEqual(value is None, same is None)
                        self.assertAlmostEqual(value or 0, same or 0, delta=1e-6 * abs(same or 1))
            n_thresholds += fit["identifiable"]
            own = {one["participant"].split(" ")[0]: one for one in analysis["thresholds"]
                   if one["reference_g"] == row["reference_g"]}
            self.assertEqual(set(fit["people"]), set(own))
            for who, person in fit["people"].items():
                self.assertEqual(person["why"], own[who]["why"])
                if person["identifiable"]:
                    self.assertAlmostEqual(person["value"], own[who]["threshold_75_g"], delta=1e-6)
                    n_people += 1
        self.assertGreater(n_thresholds, 0)
        self.assertGreater(n_people, 3)

    def test_json_has_the_names_of_the_contract(self):
        (fit,) = self.fits_of(RISING, *PSYCHOMETRIC)
        self.assertEqual(list(fit), ["group", "parameters", "log_likelihood", "n_trials",
                                     "identifiable", "why", "goodness_of_fit"])
        self.assertEqual((fit["group"], fit["n_trials"], fit["identifiable"], fit["why"]),
                         (None, 100, True, None))
        self.assertEqual(list(fit["parameters"]), ["threshold", "slope", "guess", "lapse"])
        threshold = fit["parameters"]["threshold"]
        self.assertEqual(list(threshold), ["value", "se", "low", "high", "fixed"])
        self.assertLess(threshold["low"], threshold["value"])
        self.assertLess(threshold["value"], threshold["high"])
        self.assertEqual(fit["parameters"]["guess"],
                         {"value": 0.0, "se": None, "low": None, "high": None, "fixed": True})

    def test_goodness_of_fit_is_printed_where_it_can_be_judged(self):
        _, text, _ = self.run_on(RISING, *PSYCHOMETRIC)
        self.assertRegex(text, r"Goodness of fit: deviance [\d.]+ \(3 df\), p = 0\.\d+ by 1000 simulated")
        adaptive = "x,n_positive,n\n1,0,2\n2,4,18\n3,16,24\n4,14,15\n5,6,6\n"
        code, text, _ = self.run_on(adaptive, *PSYCHOMETRIC)
        self.assertEqual(code, 0)
        self.assertIn("Goodness of fit can't be judged: levels have 2 to 24 trials, as where an adaptive",
                      " ".join(text.split()))
        (fit,) = self.fits_of(adaptive, *PSYCHOMETRIC)
        self.assertEqual((fit["goodness_of_fit"]["deviance"], fit["goodness_of_fit"]["p"]), (None, None))

    def test_indecision_has_a_threshold_or_null(self):
        choices = "level_g,answer\n" + "".join(
            f"{x},{answer}\n" * n for x, *counts in ((0, 9, 20, 11), (100, 3, 12, 25), (200, 0, 6, 34))
            for answer, n in zip(("reference", "none", "comparison"), counts))
        (fit,) = self.fits_of(choices, *INDECISION)
        self.assertEqual(list(fit["parameters"]), ["sensitivity", "indecision", "bias", "lapse",
                                                   "threshold_75_g"])
        self.assertAlmostEqual(fit["threshold_75_g"] * fit["parameters"]["sensitivity"]["value"],
                               0.6745)
        self.assertEqual(fit["threshold_75_g"], fit["parameters"]["threshold_75_g"]["value"])
        coin = "level_g,answer\n" + "10,reference\n10,none\n10,comparison\n" * 9 + \
            "90,reference\n90,none\n90,comparison\n" * 9
        (fit,) = self.fits_of(coin, *INDECISION)
        self.assertFalse(fit["identifiable"])
        self.assertIsNone(fit["threshold_75_g"])
        self.assertIn("no reliable sensitivity", fit["why"])
        self.assertIsNotNone(fit["parameters"]["sensitivity"]["value"])

    def test_text_is_a_table_or_says_why_not(self):
        code, text, talk = self.run_on(RISING, *PSYCHOMETRIC, "--lapse", "0.02")
        self.assertEqual((code, talk), (0, ""))
        self.assertIn("100 trials at 5 levels, log likelihood -4", text)
        self.assertRegex(text, r"threshold +\d\.\d+ +0\.\d+ +\d\.\d+ +\d\.\d+\n")
        self.assertRegex(text, r"lapse +0\.02 +- +- +- +fixed\n")
        code, text, _ = self.run_on("x,n_positive,n\n1,5,10\n2,4,10\n3,6,10\n", *PSYCHOMETRIC)
        self.assertEqual(code, 0)
        self.assertRegex(text, r"threshold +- +- +- +-\n")
        self.assertIn("No threshold: no reliable slope", text)

    def test_groups(self):
        rows = "".join(f"{row},{who}\r\n" for who in ('"B, 2"', "01")
                       for row in RISING.splitlines()[1:])
        text = "\ufeffx,n_positive,n,who\r\n" + rows
        self.assertEqual([fit["group"] for fit in self.fits_of(text, *PSYCHOMETRIC, "--by", "who")],
                         ["B, 2", "01"])
        (together,) = self.fits_of(text, *PSYCHOMETRIC)
        self.assertEqual(together["n_trials"], 200)
        self.assertEqual(self.run_on(text, *PSYCHOMETRIC, "--by", "whom")[0], 2)

    def test_a_terminal_shows_what_a_group_is_called(self):
        rows = "".join(f"{row},\x1b[2J\n" for row in RISING.splitlines()[1:])
        _, text, _ = self.run_on("x,n_positive,n,who\n" + rows, *PSYCHOMETRIC, "--by", "who")
        self.assertIn("\\x1b[2J: 100 trials", text)

    def test_bytes_that_are_no_text_make_json_all_the_same(self):
        rows = b"".join(row.encode() + b",\xff\n" for row in RISING.splitlines()[1:])
        self.data.write_bytes(b"x,n_positive,n,who\n" + rows)
        (fit,) = fits(self.data, *PSYCHOMETRIC, "--by", "who")
        self.assertEqual(fit["group"], "\ufffd")

    def test_wrong_files_are_refused_in_their_place(self):
        for text, where in (("x,n_positive,n\n1,2,3\n2,4,3\n", ":3:3: "), ("x,response\n1,2\n", ":2:3: "),
                            ("x,response\nnan,1\n", ":2:1: "), ("x,response\n1\n", ":2:1: "),
                            ('x,response\n"1,1\n', ":2:1: "), ("a,b\n1,2\n", ":1:1: ")):
            code, out, talk = self.run_on(text, *PSYCHOMETRIC)
            with self.subTest(text=text):
                self.assertEqual((code, out), (3, ""))
                self.assertTrue(talk.startswith(f"{self.data}{where}"), talk)

    def test_wrong_commands(self):
        for words in ([], ["--model", "probit"], [*PSYCHOMETRIC, "--guess", "1"],
                      [*PSYCHOMETRIC, "--lapse", "-0.1"], [*PSYCHOMETRIC, "--lapse", "fre"],
                      [*PSYCHOMETRIC, "--guess", "0.6", "--lapse", "0.4"],
                      [*PSYCHOMETRIC, "--scale", "ln"], [*INDECISION, "--guess", "0"],
                      [*PSYCHOMETRIC, "--person", "x"],
                      [*INDECISION, "--person", "level_g", "--lapse", "0.02"]):
            with self.subTest(words=words):
                self.assertEqual(self.run_on(RISING, *words)[0], 2)
        code, _, message = self.run_on("level_g,answer,who\n5,none,P1\n", *INDECISION, "--person", "whom")
        self.assertEqual(code, 2)
        self.assertIn("who", message)
        self.assertEqual(run("/nowhere.csv", *PSYCHOMETRIC).returncode, 1)

    def test_help_has_examples_and_formulas(self):
        text = run("--help-all").stdout.decode()
        self.assertIn("heft fit answers.csv --model psychometric", text)
        self.assertIn("threshold_75_g = 0.6745 / sensitivity", text)


if __name__ == "__main__":
    fit_harness.program = sys.argv.pop(1)
    unittest.main()

"""heft.fit: the figures of `heft fit`, from files and data frames, and its mistakes.

Run: PYTHONPATH=build/python python3 tests/python/fit_test.py build/heft
"""
import json
import random
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import pandas

import heft

PROGRAM = sys.argv.pop(1)
GOLDEN = Path(__file__).resolve().parents[1] / "golden" / "fit"


def by_program(data, *words):
    done = subprocess.run([PROGRAM, "fit", data, *words, "--json"], capture_output=True, text=True,
                          timeout=300)
    return json.loads(done.stdout) if done.returncode == 0 else done.stderr


def as_json(fit, group):
    """As the program prints it."""
    found = {"group": group,
             "parameters": {name: one._asdict() for name, one in fit.parameters.items()},
             "log_likelihood": fit.log_likelihood, "n_trials": fit.n_trials,
             "identifiable": fit.identifiable, "why": fit.why,
             "goodness_of_fit": fit.goodness_of_fit._asdict()}
    if "threshold_75_g" in fit.parameters:
        found["threshold_75_g"] = fit.parameters["threshold_75_g"].value
    if fit.people:
        found["people"] = {name: one._asdict() for name, one in fit.people.items()}
    return found


def choices_of(n_people, n_trials, rng):
    """People whose thresholds differ."""
    rows = []
    for person in range(n_people):
        sensitivity = 0.01 * 2 ** rng.gauss(0, 0.5)
        for _ in range(n_trials):
            level = rng.choice([-200, -100, -50, 50, 100, 200])
            seen = sensitivity * level + rng.gauss(0, 1)
            answer = "comparison" if seen > 0.5 else "reference" if seen < -0.5 else "none"
            rows.append({"level_g": level, "answer": answer, "who": f"P{person}"})
    return pandas.DataFrame(rows)


class Figures(unittest.TestCase):
    def test_of_files_are_those_of_the_program(self):
        n = 0
        for case in json.loads((GOLDEN / "psychometric.json").read_text()):
            words = [word for word in case["arguments"] if word != "--json"]
            options = {word[2:]: value for word, value in zip(words[::2], words[1::2])}
            fits = heft.fit(GOLDEN / case["file"], options.pop("model"), **options)
            expected = by_program(GOLDEN / case["file"], *words)
            self.assertEqual([as_json(fit, group) for group, fit in fits.items()], expected)
            n += len(fits)
        self.assertGreater(n, 50)

    def test_of_data_frames_are_those_of_files(self):
        rng = random.Random(1)
        trials = pandas.DataFrame({"x": [rng.uniform(0, 10) for _ in range(200)]})
        trials["response"] = trials.x + [rng.gauss(0, 2) for _ in range(200)] > 5
        fit = heft.fit(trials, "psychometric", function="logistic", lapse=0.02)
        again = heft.fit({"x": list(trials.x), "response": list(trials.response)}, "psychometric",
                         function="logistic", lapse="0.02")
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            trials.astype({"response": int}).to_csv(file.name, index=False)
            expected = by_program(file.name, "--model", "psychometric", "--function", "logistic",
                                  "--lapse", "0.02")
        self.assertEqual([as_json(fit, None)], expected)
        self.assertEqual(again, fit)
        threshold = fit.parameters["threshold"]
        self.assertTrue(threshold.low < threshold.value < threshold.high)
        self.assertTrue(threshold.low < 5 < threshold.high)
        self.assertTrue(fit.parameters["lapse"].fixed)

    def test_of_several_people_are_those_of_the_mixed_model(self):
        choices = choices_of(6, 80, random.Random(2))
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            choices.to_csv(file.name, index=False)
            expected = by_program(file.name, "--model", "indecision", "--person", "who")
        fit = heft.fit(choices, "indecision", person="who")
        self.assertEqual([as_json(fit, None)], expected)
        self.assertEqual(len(fit.people), 6)
        threshold = fit.parameters["threshold_75_g"]
        self.assertTrue(threshold.low < threshold.value < threshold.high)

    def test_people_who_are_pooled_are_warned_of(self):
        choices = choices_of(2, 20, random.Random(3)).rename(columns={"who": "person"})
        with self.assertWarnsRegex(UserWarning, "trials of 2 people are pooled.*option person"):
            heft.fit(choices, "indecision")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(list(heft.fit(choices, "indecision", by="person")), ["P0", "P1"])


class Mistakes(unittest.TestCase):
    def test_are_those_of_the_program(self):
        data = {"x": [1, 2, 3], "response": [0, 1, 7]}
        for message, options in (
                (r'data:4:3: response is "7", expected 0 or 1', {}),
                ('no function "probit"; expected "cumulative_normal"', {"function": "probit"}),
                (r'no scale "log"; expected "linear"|did you mean "log10"', {"scale": "log"}),
                ('guess is "1.5", expected "free" or a number', {"guess": 1.5}),
                ('lapse is "nan"', {"lapse": float("nan")}),
                ("guess and lapse add up", {"guess": 0.5, "lapse": 0.5}),
                ("person belongs to the model indecision", {"person": "x"}),
                ('no column "who"', {"by": "who"})):
            with self.subTest(options=options), self.assertRaisesRegex(ValueError, message):
                heft.fit(data, "psychometric", **options)
        with self.assertRaisesRegex(ValueError, 'no model "mixed"'):
            heft.fit(data, "mixed")
        with self.assertRaises(FileNotFoundError):
            heft.fit("nowhere.csv", "psychometric")

    def test_no_threshold_is_no_error(self):
        fit = heft.fit({"x": [1, 2, 3], "n_positive": [10, 10, 10], "n": [20, 20, 20]},
                       "psychometric")
        self.assertFalse(fit.identifiable)
        self.assertTrue(fit.why)
        self.assertIsNone(fit.parameters["threshold"].value)


if __name__ == "__main__":
    unittest.main()

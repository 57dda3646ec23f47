"""`heft procedure` with quest, quest_plus and psi against implementations in plain Python: levels,
posteriors, ends. Run as: python3 bayesian_test.py PATH_TO_HEFT
"""
import json
import math
import random
import sys
import unittest

import procedure_harness
from procedure_harness import answers_to_lines, heft, only, toml
from reference_bayes import LeastEntropy, Quest, curve, outcomes

CHOICES = ("comparison", "reference", "none")


def line_of(answer, level=None):
    line = {"answer": answer} if answer in CHOICES else {"response": answer}
    return json.dumps(line | ({} if level is None else {"level": level})) + "\n"


class Oracle(unittest.TestCase):
    def run_heft(self, keys, lines):
        code, events, stderr = heft(toml([dict(name="s") | keys]), "".join(lines).encode(),
                                    "--posterior")
        self.assertEqual((code, stderr, only(events, "error")), (0, "", []), keys)
        return events

    def assert_posteriors(self, events, expected, tolerance):
        posteriors = only(events, "posterior")
        self.assertEqual(len(posteriors), len(expected))
        for event, parameters in zip(posteriors, expected):
            self.assertEqual(event["parameters"].keys(), parameters.keys())
            for name, numbers in parameters.items():
                for key, value in numbers.items():
                    self.assertAlmostEqual(event["parameters"][name][key], value,
                                           delta=tolerance * max(1, abs(value)),
                                           msg=(event["trial"], name, key))


class QuestTraces(Oracle):
    def compare(self, rng):
        placement = rng.choice(["quantile", "mean", "mode"])
        guess, sd = rng.uniform(-3, 1), rng.uniform(0.3, 3)
        gamma, beta = rng.choice([0, 0.03, 0.25, 0.5]), rng.uniform(1.5, 5)
        delta, n = rng.choice([0.01, 0.02, 0.05]), rng.choice([250, 100])
        p = gamma + (1 - gamma) * rng.uniform(0.4, 0.8)
        keys = dict(kind="quest", guess=guess, guess_sd=sd, p_threshold=p, beta=beta, delta=delta,
                    gamma=gamma, placement=placement, stop_trials=30)
        if n == 100:
            keys |= {"range": 2}
        reference = Quest(guess, sd, p, beta, delta, gamma, 0.01, n)
        levels, lines, posteriors = [], [], []
        for _ in range(30):
            levels.append(reference.level(placement))
            answer = rng.random() < 0.7
            shown = levels[-1] + rng.choice([0, 0, rng.uniform(-4, 4)])
            lines.append(line_of(answer, shown))
            reference.answer(shown, answer)
            posteriors.append(reference.posterior())
        events = self.run_heft(keys, lines)
        self.assert_posteriors(events, posteriors, 1e-8)
        trials = only(events, "trial")
        self.assertEqual(len(trials), 30)
        for trial, level in zip(trials, levels):
            self.assertAlmostEqual(trial["level"], level, delta=1e-8)
            self.assertEqual(trial["recommended"], trial["level"])

    def test_random_settings(self):
        rng = random.Random("quest")
        for _ in range(30):
            self.compare(rng)


class LeastEntropyTraces(Oracle):
    GRIDS = {"threshold": 9, "slope": 4, "guess": 2, "lapse": 3}
    OF_CHOICE = {"sensitivity": 8, "indecision": 5, "bias": 3, "lapse": 2}
    RANGES = {"threshold": (-4, 4), "slope": (0.5, 5), "guess": (0, 0.5), "lapse": (0.001, 0.2),
              "sensitivity": (0.005, 0.08), "indecision": (0, 3), "bias": (-1, 1)}

    def grid(self, rng, name, most):
        low, high = self.RANGES[name]
        return sorted(round(rng.uniform(low, high), 6) for _ in range(rng.randint(1, most)))

    def settings(self, rng, kind, function):
        sizes = self.OF_CHOICE if function == "indecision" else self.GRIDS
        grids = {name: self.grid(rng, name, most) for name, most in sizes.items()}
        scale = rng.choice(["linear", "log10", "db"]) if function == "weibull" else "linear"
        levels = sorted(rng.uniform(-5, 5) for _ in range(rng.randint(2, 12)))
        if function == "weibull" and scale == "linear":
            levels = [abs(level) for level in levels]
            grids["threshold"] = [abs(t) + 0.1 for t in grids["threshold"]]
        if function == "indecision":
            levels = [30 * level for level in levels]
        levels = sorted(levels)
        grids = {name: sorted(values) for name, values in grids.items()}
        first, second = list(grids)[:2]
        nuisance = []
        if kind == "psi":
            for name in (first, second):
                if len(grids[name]) == 1:
                    grids[name] = [grids[name][0], grids[name][0] + self.RANGES[name][1]]
            nuisance = rng.choice([[], [second], list(grids)[2:], ["lapse"]])
        return scale, levels, grids, nuisance

    def compare(self, rng, kind, function, n_trials=15):
        scale, levels, grids, nuisance = self.settings(rng, kind, function)
        keys = dict(kind=kind, function=function, scale=scale, levels=levels,
                    stop_trials=n_trials) | grids
        if kind == "psi" and nuisance:
            keys["nuisance"] = nuisance
        reference = LeastEntropy(function, scale, levels, grids, nuisance)
        truth = [rng.choice(values) for values in grids.values()]
        lines, posteriors, expected = [], [], []
        level = levels[len(levels) // 2]
        for _ in range(n_trials):
            expected.append(reference.expected_entropies())
            # Answers of an observer, or at random, at levels of the grid and others.
            shares = outcomes(function, scale, truth, level)
            answer = rng.choices(list(shares), [max(p, 0) for p in shares.values()])[0]
            if rng.random() < 0.1:
                answer = rng.choice(list(shares))
            lines.append(line_of(answer, level))
            reference.answer(level, answer)
            posteriors.append(reference.posterior())
            level = rng.choice(levels + [levels[0] + (levels[-1] - levels[0]) * rng.random()])
        events = self.run_heft(keys, lines)
        self.assert_posteriors(events, posteriors, 1e-6)
        trials = only(events, "trial")
        self.assertEqual(len(trials), n_trials)
        for trial, entropies in zip(trials, expected):
            self.assertLess(entropies[levels.index(trial["level"])], min(entropies) + 2e-7, keys)
            best = entropies.index(min(entropies))
            if sum(e < min(entropies) + 4e-7 for e in entropies) == 1:
                self.assertEqual(trial["level"], levels[best], keys)

    def test_random_grids(self):
        for kind in ("quest_plus", "psi"):
            for function in ("weibull", "cumulative_normal", "logistic", "gumbel", "indecision"):
                rng = random.Random(f"{kind} {function}")
                for _ in range(4):
                    self.compare(rng, kind, function)

    def test_watsons_example(self):
        # Watson (2017), figure 2: threshold of contrast in dB, slope 3.5, guess .5, lapse .02.
        levels = list(range(-40, 1))
        grids = {"threshold": levels, "slope": [3.5], "guess": [0.5], "lapse": [0.02]}
        reference = LeastEntropy("weibull", "db", levels, grids)
        rng, answers, expected = random.Random(5), [], []
        for _ in range(32):
            entropies = reference.expected_entropies()
            expected.append(levels[entropies.index(min(entropies))])
            p = 0.5 + 0.48 * curve("weibull", "db", expected[-1], -20, 3.5)
            answers.append(rng.random() < p)
            reference.answer(expected[-1], answers[-1])
        keys = dict(kind="quest_plus", function="weibull", scale="db", levels=levels,
                    stop_trials=32) | grids
        events = self.run_heft(keys, [line_of(answer) for answer in answers])
        self.assertEqual([e["level"] for e in only(events, "trial")], expected)
        [finished] = only(events, "finished")
        threshold = reference.posterior()["threshold"]
        for key, of_posterior in (("estimate", "mean"), ("sd", "sd"), ("low", "low"),
                                  ("high", "high")):
            self.assertAlmostEqual(finished[key], threshold[of_posterior], delta=1e-6)
        self.assertEqual((finished["reason"], finished["censored"]), ("trials", "none"))
        for key, value in threshold.items():
            self.assertAlmostEqual(finished["parameters"]["threshold"][key], value, delta=1e-6)


class Ends(Oracle):
    PSI = dict(kind="psi", function="cumulative_normal", levels=list(range(0, 301, 10)),
               threshold=list(range(10, 301, 10)), slope=[10, 20, 40, 80, 160], guess=[0, 0.05],
               lapse=[0.02], nuisance=["guess"], stop_trials=60)

    def finished(self, keys, answer, seed=1):
        """With answers that depend on the level."""
        rng, lines = random.Random(seed), []
        for _ in range(keys["stop_trials"]):
            events = self.run_heft(keys, lines)
            if only(events, "finished"):
                break
            lines.append(line_of(answer(rng, only(events, "trial")[-1]["level"])))
        return only(self.run_heft(keys, lines), "finished")[0]

    def test_precision_ends_at_the_first_posterior_that_is_narrow_enough(self):
        keys = self.PSI | dict(stop_ci_width=70)
        finished = self.finished(keys, lambda rng, level: rng.gauss(level, 20) > 120)
        self.assertEqual(finished["reason"], "precision")
        self.assertLessEqual(finished["high"] - finished["low"], 70)
        self.assertLess(finished["n_trials"], 60)
        self.assertAlmostEqual(finished["estimate"], 120, delta=40)
        self.assertEqual(finished["parameters"]["threshold"]["mean"], finished["estimate"])
        self.assertEqual(set(finished["parameters"]), {"threshold", "slope", "guess", "lapse"})

    def test_always_yes_has_only_a_bound(self):
        finished = self.finished(self.PSI, lambda rng, level: True)
        self.assertEqual((finished["estimate"], finished["low"]), (None, None))
        self.assertIn(finished["censored"], ("below", "indeterminate"))

    def test_never_has_no_estimate(self):
        finished = self.finished(self.PSI, lambda rng, level: False)
        self.assertEqual((finished["estimate"], finished["parameters"]), (None, None))
        self.assertIn(finished["censored"], ("above", "indeterminate"))

    def test_a_start_is_the_first_level_only(self):
        keys = self.PSI | dict(start=123, floor=50, ceiling=200)
        events = self.run_heft(keys, [line_of(True)] * 20 + [line_of(False)] * 20)
        levels = [event["level"] for event in only(events, "trial")]
        self.assertEqual(levels[0], 123)
        self.assertTrue(all(level % 10 == 0 and 50 <= level <= 200 for level in levels[1:]))

    def test_a_void_trial_changes_nothing(self):
        answers = [line_of(answer) for answer in (True, False, True, True)]
        voids = [line for answer in answers for line in ('{"void":true}\n', answer)]
        plain, voided = self.run_heft(self.PSI, answers), self.run_heft(self.PSI, voids)
        self.assertEqual([e["level"] for e in only(plain, "trial")],
                         [e["level"] for e in only(voided, "trial")][::2])

    def test_without_posterior_the_lines_are_those_of_every_kind(self):
        code, events, stderr = heft(toml([dict(name="s") | self.PSI]), answers_to_lines([True] * 3))
        self.assertEqual((code, stderr), (0, ""))
        self.assertEqual([e.keys() - {"event"} for e in events],
                         [{"trial", "staircase", "level"}] * 4)

    def test_an_answer_without_a_choice_counts_as_either_choice(self):
        grids = {"sensitivity": [0.01, 0.02, 0.05], "indecision": [0.5, 1, 2], "bias": [0],
                 "lapse": [0.02]}
        levels = [-40, 0, 40, 80]
        keys = dict(kind="quest_plus", function="indecision", levels=levels, stop_trials=9) | grids
        reference = LeastEntropy("indecision", "linear", levels, grids)
        for i, point in enumerate(reference.points):
            p = outcomes("indecision", "linear", point, 40)
            reference.logs[i] += math.log(p["comparison"] + p["reference"])
        reference.answer(80, "none")
        lines = [line_of(True, 40), line_of(False, 80)]
        posterior = only(self.run_heft(keys, lines), "posterior")[-1]["parameters"]
        for name, numbers in reference.posterior().items():
            self.assertAlmostEqual(posterior[name]["mean"], numbers["mean"], delta=1e-9)


if __name__ == "__main__":
    procedure_harness.program = sys.argv.pop(1)
    unittest.main()

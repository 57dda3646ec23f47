"""heft.Procedure: the trials of `heft procedure`, line by line, and mistakes in settings and answers.

Run: PYTHONPATH=build/python HEFT_SEED=N python3 tests/python/procedure_test.py build/heft
"""
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import heft

SEED = int(os.environ.get("HEFT_SEED", random.randrange(10**6)))
PROGRAM = sys.argv.pop(1)
GOLDEN = Path(__file__).resolve().parents[1] / "golden" / "procedures"


def some_keys(kind, rng):
    """Settings of a kind, drawn at random."""
    common = {"kind": kind, "stop_trials": rng.randint(5, 40)}
    grid = {"from": 10, "to": 300, "step": 10}
    if kind == "up_down":
        return common | {"start": rng.uniform(50, 200), "step": rng.uniform(5, 60), "floor": 0,
                         "halve_every": rng.randint(0, 3), "down": rng.randint(1, 3),
                         "stop_reversals": rng.randint(3, 12),
                         "at_bound": rng.choice(["clamp", "virtual"])}
    if kind == "constant":
        return {"kind": kind, "levels": [rng.uniform(-50, 50) for _ in range(5)],
                "n_per_level": rng.randint(1, 5), "order": rng.choice(["blocks", "shuffled"])}
    if kind == "quest":
        return common | {"guess": rng.uniform(1, 2), "guess_sd": rng.uniform(0.5, 2),
                         "placement": rng.choice(["quantile", "mean", "mode"])}
    if kind == "quest_plus":
        return common | {"function": "indecision", "levels": {"from": -200, "to": 200, "step": 25},
                         "sensitivity": {"from": 0.002, "to": 0.1, "n": 8, "spacing": "log"},
                         "indecision": [0.5, 1, 2], "bias": 0, "lapse": 0.02}
    return common | {"function": rng.choice(["cumulative_normal", "logistic", "gumbel"]),
                     "levels": grid, "threshold": grid, "slope": [10, 20, 40, 80], "guess": 0,
                     "lapse": [0.01, 0.05], "nuisance": ["lapse"],
                     "stop_ci_width": rng.uniform(20, 100)}


KINDS = ["up_down", "constant", "quest", "quest_plus", "psi"]


def some_answer(trial, rng):
    """A line for `heft procedure`."""
    if rng.random() < 0.1:
        return {"void": True}
    if rng.random() < 0.5:
        answer = {"response": rng.random() < 0.5}
    else:
        answer = {"answer": rng.choice(["comparison", "reference", "none"])}
    if rng.random() < 0.2:
        answer["level"] = trial.level + rng.uniform(-1, 1)
    return answer


def finished_event(staircase):
    estimate = staircase.estimates[0]
    event = {"event": "finished", "staircase": staircase.name, "reason": staircase.stopped_by,
             "estimate": estimate.value, "low": estimate.low, "high": estimate.high}
    if staircase.posterior:
        parameters = {name: one._asdict() for name, one in staircase.posterior.items()}
        event |= {"sd": estimate.sd, "censored": estimate.censored,
                  "parameters": None if estimate.value is None else parameters}
    return event | {"n_trials": staircase.n_trials}


def events_of(procedure, choose, answers):
    """Runs it with answers that `choose` makes, as the events of `heft procedure --posterior`."""
    events = []
    for trial in procedure:
        staircase = procedure.staircases[trial.staircase]
        events.append({"event": "trial", "trial": trial.number, "staircase": trial.staircase,
                       "level": trial.level})
        if staircase.posterior:
            events[-1]["recommended"] = trial.level
        answer = choose(trial)
        answers.append(answer)
        if "void" in answer:
            trial.void()
            continue
        response = answer["response"] if "response" in answer else answer["answer"]
        reversal = trial.answer(response, answer.get("level"))
        if reversal:
            assert reversal == staircase.reversals[-1]
            events.append({"event": "reversal", "staircase": trial.staircase, **reversal._asdict()})
        if staircase.posterior:
            events.append({"event": "posterior", "staircase": trial.staircase, "trial": trial.number,
                           "parameters": {name: one._asdict()
                                          for name, one in staircase.posterior.items()}})
        if staircase.stopped_by:
            events.append(finished_event(staircase))
    return events + [{"event": "done"}]


def toml(staircases, **keys):
    """A procedure file, written independently of the module."""
    def value(of):
        if isinstance(of, dict):
            return "{ " + ", ".join(f"{key} = {value(one)}" for key, one in of.items()) + " }"
        return json.dumps(of)
    lines = [f"{key} = {value(one)}" for key, one in keys.items()]
    for staircase in staircases:
        lines += ["[[staircase]]", *(f"{key} = {value(one)}" for key, one in staircase.items())]
    return "\n".join(lines)


class Traces(unittest.TestCase):
    def compare(self, staircases, rng, **keys):
        procedure, answers = heft.Procedure(*staircases, **keys), []
        events = events_of(procedure, lambda trial: some_answer(trial, rng), answers)
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(toml(staircases, **keys))
            file.flush()
            done = subprocess.run([PROGRAM, "procedure", file.name, "--posterior"], text=True,
                                  input="".join(json.dumps(answer) + "\n" for answer in answers),
                                  capture_output=True, check=True, timeout=60)
        self.assertEqual(events, [json.loads(line) for line in done.stdout.splitlines()])
        self.assertTrue(procedure.finished)
        return len(answers)

    def test_each_kind_alone(self):
        said = subprocess.run([PROGRAM, "procedure", "--help-all"], capture_output=True, text=True)
        self.assertEqual(re.findall(r'^ *kind = "(\w+)"', said.stdout, re.M), KINDS)
        for kind in KINDS:
            rng, n = random.Random(f"{SEED} {kind}"), 0
            for _ in range(25):
                keys = {"name": "s"} | some_keys(kind, rng)
                with self.subTest(seed=SEED, keys=keys):
                    n += self.compare([keys], rng, seed=rng.randrange(10**9))
            print(f"{kind}: {n} trials, seed {SEED}", file=sys.stderr)

    def test_all_kinds_interleaved(self):
        rng = random.Random(SEED)
        for _ in range(20):
            staircases = [{"name": kind} | some_keys(kind, rng) for kind in KINDS]
            keys = {"seed": rng.randrange(10**9), "max_lag": rng.randint(0, 5),
                    "interleave": rng.choice(["random", "round_robin", "sequential"])}
            with self.subTest(of=SEED, staircases=staircases, **keys):
                self.compare(staircases, rng, **keys)

    def test_files_of_the_goldens(self):
        for file in sorted(GOLDEN.glob("*/procedure.toml")):
            first = json.loads(file.with_name("out.jsonl").read_text().splitlines()[0])
            trial = heft.Procedure.from_file(file).trial
            self.assertEqual((trial.number, trial.staircase, trial.level),
                             (first["trial"], first["staircase"], first["level"]))


class Use(unittest.TestCase):
    UP_DOWN = {"kind": "up_down", "start": 175, "step": 50, "floor": 0, "stop_reversals": 4}

    def test_a_loop(self):
        staircase = heft.Procedure(self.UP_DOWN)
        for trial in staircase:
            trial.answer(trial.level > 62)
        self.assertEqual(staircase.reversals[0], heft.Reversal(1, 4, 25, 50, 50))
        self.assertEqual((staircase.finished, staircase.trial, staircase.level), (True, None, None))
        self.assertEqual(staircase.estimates[0].value, 50)
        self.assertEqual(staircase.estimates[0].method, "mean_of_reversals")
        self.assertEqual(staircase.posterior, {})

    def test_answers_without_a_loop(self):
        staircase = heft.Procedure(self.UP_DOWN)
        staircase.answer("comparison")
        staircase.void()
        self.assertEqual((staircase.trial.number, staircase.level), (3, 125))
        staircase.answer(0)
        self.assertEqual(staircase.level, 175)

    def test_a_file_as_a_dict_and_values_of_numpy(self):
        import numpy
        keys = {"kind": "constant", "levels": numpy.array([1.5, 2]), "n_per_level": numpy.int64(2)}
        by_dict = heft.Procedure({"seed": 3, "staircase": [{"name": "a", **keys}]})
        again = heft.Procedure({"name": "a", **keys}, seed=3)
        levels = [[trial.level for trial in one if trial.answer(numpy.bool_(True)) is None]
                  for one in (by_dict, again)]
        self.assertEqual(levels[0], levels[1])
        self.assertEqual(sorted(levels[0]), [1.5, 1.5, 2, 2])

    def test_several_staircases_are_named(self):
        both = heft.Procedure({"name": "a", **self.UP_DOWN}, {"name": "b", **self.UP_DOWN})
        self.assertEqual(list(both.staircases), ["a", "b"])
        with self.assertRaisesRegex(ValueError, r"2 staircases.*staircases\['a'\]"):
            both.estimates


class Mistakes(unittest.TestCase):
    def refused(self, message, call, *words, error=ValueError, **keys):
        with self.assertRaisesRegex(error, message):
            call(*words, **keys)

    def test_in_settings_are_those_of_the_program(self):
        for text in ('[[staircase]]\nname = "a"\nstart = 1\nstep = "x"\nfoo = 3\n', "seed = 1\n",
                     "a = [", '[[staircase]]\nkind = "qust"\n'):
            with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
                file.write(text)
                file.flush()
                said = subprocess.run([PROGRAM, "procedure", file.name], capture_output=True,
                                      text=True, input="").stderr
                for make in (lambda: heft.Procedure.from_toml(text, file.name),
                             lambda: heft.Procedure.from_file(file.name)):
                    with self.assertRaises(ValueError) as raised:
                        make()
                    self.assertEqual(str(raised.exception).strip(), said.strip())

    def test_in_settings_name_the_key(self):
        self.refused(r'procedure:5:\d+: step is "wide"', heft.Procedure,
                     {"kind": "up_down", "start": 5, "step": "wide"})
        self.refused('unknown key "sead"', heft.Procedure, Use.UP_DOWN, sead=3)
        self.refused("is no value of a procedure", heft.Procedure, {"start": object()})
        self.refused('lacks "staircase"', heft.Procedure)
        self.refused("nowhere.toml", heft.Procedure.from_file, "nowhere.toml", error=OSError)

    def test_in_answers(self):
        staircase = heft.Procedure(Use.UP_DOWN)
        self.refused('no answer "comparisn", did you mean "comparison"', staircase.answer,
                     "comparisn")
        for response in (None, 2, 0.5, b"none"):
            self.refused("the response is", staircase.answer, response)
        for level in (float("nan"), float("inf"), -1e301):
            self.refused("the level is", staircase.answer, True, level)
        first = staircase.trial
        self.assertEqual(first.number, 1)
        first.answer(True)
        self.refused("is not open any more", first.answer, True)
        self.refused("is not open any more", first.void)

    def test_after_the_end(self):
        staircase = heft.Procedure({"kind": "constant", "levels": [1], "n_per_level": 1})
        staircase.answer(True)
        self.refused("all staircases are finished", staircase.answer, True)
        self.refused("all staircases are finished", staircase.void)

    def test_a_loop_without_answers_ends(self):
        def loop():
            for _ in heft.Procedure(Use.UP_DOWN):
                pass
        self.refused("trial 1 is still open", loop, error=RuntimeError)


if __name__ == "__main__":
    unittest.main()

"""`heft procedure` from outside: other programs' traces, the conversation, and what it survives.

Run as: python3 procedure_test.py PATH_TO_HEFT
"""
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import procedure_harness
from procedure_garbage import EXTREMES, mutated, understood
from procedure_harness import answers_to_lines, command, heft, mean, only, toml
from reference_staircases import (Expyfun, Palamedes, Paper, PsychoPy, Pychoacoustics,
                                  UnityToolkit)

GOLDEN = pathlib.Path(__file__).resolve().parents[2] / "golden" / "procedures"


class OtherProgramsTraces(unittest.TestCase):
    """Levels, reversals and estimates to the last bit."""

    def compare(self, reference, rng, first=()):
        p = rng.choice([0.1, 0.3, 0.5, 0.7, 0.9])
        n_trials = 400
        answers = list(first) + [rng.random() < p for _ in range(n_trials - len(first))]
        discard = rng.choice([0, 0, 1, 2])
        keys = dict(name="s", discard_reversals=discard) | reference.keys()
        keys["discard_reversals"] = min(discard, keys.get("stop_reversals", 10) - 1)
        code, events, stderr = heft(toml([keys]), answers_to_lines(answers))
        self.assertEqual((code, stderr), (0, ""), keys)
        levels = []
        for answer in answers:
            levels.append(reference.level)
            reference.answer(answer)
            if reference.finished:
                break
        else:
            levels.append(reference.level)  # the trial that is open when the input ends
        self.assertEqual([e["level"] for e in only(events, "trial")], levels, keys)
        self.assertEqual([e["level"] for e in only(events, "reversal")], reference.reversals, keys)
        self.assertEqual(len(only(events, "finished")), int(reference.finished), keys)
        if reference.finished:
            self.assert_finished(events, reference.reversals[keys["discard_reversals"]:], levels)

    def assert_finished(self, events, kept, levels):
        self.assertEqual(events[-1], {"event": "done"})
        finished = events[-2]
        self.assertEqual(finished["event"], "finished")
        self.assertEqual(finished["n_trials"], len(levels))
        self.assertEqual(finished["estimate"], mean(kept) if kept else None)

    def many(self, n, make, first=lambda reference: ()):
        rng = random.Random(f"{self.id()}")
        for _ in range(n):
            reference = make(rng)
            self.compare(reference, rng, first(reference))

    def test_psychopy(self):
        def make(rng):
            step_type = rng.choice(["lin", "db", "log"])
            size = {"lin": 20, "db": 8, "log": 0.4}[step_type]
            steps = [round(rng.uniform(0.01, size), rng.choice([1, 2, 6])) or size
                     for _ in range(rng.randint(1, 5))]
            start = round(rng.uniform(1, 100), 2)
            return PsychoPy(start, steps, rng.randint(1, 3), rng.randint(1, 4), step_type,
                            rng.random() < 0.5, rng.randint(len(steps), 12), rng.randint(0, 60),
                            rng.choice([None, 0.5, round(start / 2, 3)]),
                            rng.choice([None, 120, round(start * 1.5, 3)]))
        self.many(200, make)

    def test_expyfun(self):
        def make(rng):
            n = rng.randint(1, 4)
            rule = rng.choice(["reversals", "trials"])
            changes = sorted(rng.sample(range(1, 30 if rule == "trials" else 10), n - 1))
            start = rng.uniform(-5, 5)
            return Expyfun(rng.randint(1, 3), rng.randint(1, 4),
                           [rng.uniform(0.1, 3) for _ in range(n)],
                           [rng.uniform(0.1, 3) for _ in range(n)], changes, rng.randint(1, 15),
                           rng.randint(5, 80), start, start - rng.uniform(0, 8),
                           start + rng.uniform(0.1, 8), rule)
        self.many(200, make)

    def test_palamedes(self):
        def make(rng):
            up, down = rng.choice([(1, 1), (1, 2), (1, 3), (2, 1), (3, 1)])
            start = rng.uniform(-1, 1)
            return Palamedes(up, down, rng.uniform(0.01, 1), rng.uniform(0.01, 1), start,
                             start - rng.uniform(0, 2), start + rng.uniform(0.1, 2),
                             rng.random() < 0.5, rng.randint(1, 20))
        self.many(150, make)

    def test_pychoacoustics(self):
        def make(rng):
            return Pychoacoustics(rng.uniform(10, 50), rng.uniform(2, 6), rng.uniform(0.5, 2),
                                  rng.randint(1, 4), rng.choice([50, 70.7, 75, 90]),
                                  rng.randint(1, 4), rng.randint(1, 3), rng.randint(5, 16))
        self.many(100, make, first=lambda reference: [True] * reference.n_right)

    def test_unity_toolkit(self):
        def make(rng):
            n = rng.randint(10, 60)
            until = sorted([rng.randint(1, 3), rng.randint(3, 6)])
            phases = [(rng.randint(1, 9), rng.randint(1, 9)) for _ in range(3)]
            return UnityToolkit(rng.randint(0, n), n, rng.random() < 0.5, phases, until,
                                rng.randint(1, 14))
        self.many(100, make)

    def test_paper(self):
        references = [(175, 50), (600, 150), (700, 200)]
        self.many(100, lambda rng: Paper(*rng.choice(references), rng.random() < 0.3))


class Conversation(unittest.TestCase):
    STAIRCASE = dict(name="15g", start=175.0, step=50.0, halve_every=2, floor=0.0)

    def test_goldens(self):
        folders = sorted(path.parent for path in GOLDEN.glob("*/procedure.toml"))
        self.assertGreaterEqual(len(folders), 3)
        for folder in folders:
            with self.subTest(folder.name):
                code, events, stderr = heft((folder / "procedure.toml").read_text(),
                                            (folder / "in.jsonl").read_bytes())
                self.assertEqual((code, stderr), (0, ""))
                for error in only(events, "error"):
                    self.assertIn("expected", error.pop("message"))
                expected = (folder / "out.jsonl").read_text().splitlines()
                self.assertEqual(events, [json.loads(line) for line in expected])

    def test_written_as_the_contract_shows(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(toml([self.STAIRCASE]))
            file.flush()
            run = subprocess.run(command(file.name), capture_output=True, timeout=60,
                                 input=answers_to_lines([True, True, False]))
        self.assertEqual(run.stdout.decode().splitlines()[2:4], [
            '{"event":"trial","trial":3,"staircase":"15g","level":75}',
            '{"event":"reversal","staircase":"15g","trial":3,"number":1,"level":75,'
            '"step_before":50,"step_after":50}'])

    def test_every_line_is_flushed(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(toml([self.STAIRCASE]))
            file.flush()
            with subprocess.Popen(command(file.name), stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, text=True) as talk:
                for level in (175, 125, 75):  # would hang here, up to the test's time limit
                    self.assertEqual(json.loads(talk.stdout.readline())["level"], level)
                    talk.stdin.write('{"response":true}\n')
                    talk.stdin.flush()
                talk.stdin.close()
                self.assertEqual(len(talk.stdout.read().splitlines()), 1)
            self.assertEqual(talk.returncode, 0)

    def test_ends_cleanly_wherever_the_input_ends(self):
        procedure = toml([self.STAIRCASE])
        for text, n_trials in ((b"", 1), (b"\n\r\n  \n", 1), (b'{"response":true}', 2),
                               (b'{"response":true}\n{"resp', 2), (b'{"void":true}\r\n', 2)):
            code, events, stderr = heft(procedure, text)
            self.assertEqual((code, stderr, len(only(events, "trial"))), (0, "", n_trials), text)

    def test_always_yes_at_the_floor_ends(self):
        lines = answers_to_lines([True] * 500)
        events = heft(toml([self.STAIRCASE]), lines)[1]
        self.assertEqual(events[-2], {"event": "finished", "staircase": "15g", "reason": "trials",
                                      "estimate": None, "low": None, "high": None,
                                      "n_trials": 200})
        events = heft(toml([self.STAIRCASE | {"bound_is_reversal": True}]), lines)[1]
        self.assertEqual(events[-2], {"event": "finished", "staircase": "15g", "estimate": 0,
                                      "low": None, "high": None, "reason": "reversals",
                                      "n_trials": 13})

    def interleaved(self, **keys):
        """Three different staircases; answers and voids at random. -> events, answers by trial"""
        rng = random.Random(5)
        staircases = [Paper(175, 50), Paper(600, 150), Paper(700, 200)]
        procedure = toml([dict(name=str(i)) | s.keys() for i, s in enumerate(staircases)], **keys)
        answers = [rng.choice([True, False, None]) for _ in range(600)]
        lines = [{"void": True} if a is None else {"response": a} for a in answers]
        code, events, stderr = heft(procedure,
                                    "".join(json.dumps(line) + "\n" for line in lines).encode())
        self.assertEqual((code, stderr, events[-1]), (0, "", {"event": "done"}))
        return staircases, events, answers

    def test_interleaved_staircases_keep_their_own_traces(self):
        for order in ("random", "round_robin", "sequential"):
            staircases, events, answers = self.interleaved(interleave=order, seed=3)
            trials = only(events, "trial")
            self.assertEqual([t["trial"] for t in trials], list(range(1, len(trials) + 1)))
            for trial, answer in zip(trials, answers):
                reference = staircases[int(trial["staircase"])]
                self.assertFalse(reference.finished)
                self.assertEqual(trial["level"], reference.level)
                if answer is not None:
                    reference.answer(answer)
            self.assertTrue(all(reference.finished for reference in staircases))
            for finished in only(events, "finished"):
                self.assertEqual(finished["estimate"],
                                 mean(staircases[int(finished["staircase"])].reversals[2:]))

    def test_lag_is_held(self):
        staircases, events, answers = self.interleaved(interleave="random", max_lag=2, seed=9)
        done = {name: 0 for name in "012"}
        for trial, answer in zip(only(events, "trial"), answers):
            open_ones = [done[n] for n in "012" if not staircases[int(n)].finished]
            self.assertLessEqual(done[trial["staircase"]] + 1 - min(open_ones), 2)
            if answer is not None:
                staircases[int(trial["staircase"])].answer(answer)
                done[trial["staircase"]] += 1

    def test_void_draws_anew(self):
        procedure = toml([self.STAIRCASE | {"name": name} for name in "ab"], seed=1)
        events = heft(procedure, b'{"void":true}\n' * 1000)[1]
        self.assertEqual({e["level"] for e in events}, {175})
        n_a = sum(e["staircase"] == "a" for e in events)
        self.assertEqual(len(events), 1001)
        self.assertLess(abs(n_a - 500.5), 4 * 15.8)  # four standard deviations of 1001 fair draws

    def test_same_seed_same_session(self):
        def session(seed):
            return self.interleaved(seed=seed)[1]
        self.assertEqual(session(11), session(11))
        self.assertNotEqual(session(11), session(12))


class ConstantStimuli(unittest.TestCase):
    LEVELS = [-40.0, 0.0, 10.0, 40.0, 160.0]

    def constant(self, **keys):
        return dict(name="c", kind="constant", levels=self.LEVELS, n_per_level=6) | keys

    def levels(self, procedure, lines):
        code, events, stderr = heft(procedure, lines)
        self.assertEqual((code, stderr), (0, ""))
        return [e["level"] for e in only(events, "trial")]

    def test_every_block_holds_each_level_once_and_it_estimates_nothing(self):
        lines = answers_to_lines([True] * 40)
        code, events, stderr = heft(toml([self.constant()], seed=4), lines)
        self.assertEqual((code, stderr), (0, ""))
        levels = [e["level"] for e in only(events, "trial")]
        self.assertEqual(len(levels), 30)
        for start in range(0, 30, 5):
            self.assertEqual(sorted(levels[start:start + 5]), self.LEVELS)
        self.assertEqual(only(events, "reversal"), [])
        self.assertEqual(events[-2:], [{"event": "finished", "staircase": "c", "reason": "trials",
                                        "estimate": None, "low": None, "high": None,
                                        "n_trials": 30}, {"event": "done"}])

    def test_shuffled_over_all_trials(self):
        levels = self.levels(toml([self.constant(order="shuffled")]), answers_to_lines([True] * 30))
        self.assertEqual(sorted(levels), sorted(self.LEVELS * 6))
        self.assertTrue(any(sorted(levels[i:i + 5]) != self.LEVELS for i in range(0, 30, 5)))

    def test_only_the_seed_orders_the_levels(self):
        def order(seed, lines):
            return self.levels(toml([self.constant()], seed=seed), lines)
        rng = random.Random(3)
        first = order(1, answers_to_lines([True] * 30))
        self.assertEqual(first, order(1, answers_to_lines([rng.random() < 0.5 for _ in range(30)])))
        self.assertEqual(first, order(1, b'{"answer":"none","level":3}\n' * 30))
        self.assertNotEqual(first, order(2, answers_to_lines([True] * 30)))

    def test_a_void_trial_is_presented_again(self):
        lines = b'{"void":true}\n{"response":true}\n' * 30
        levels = self.levels(toml([self.constant()], seed=1), lines)
        self.assertEqual(levels[0:60:2], levels[1:60:2])
        self.assertEqual(levels[0:60:2], self.levels(toml([self.constant()], seed=1),
                                                     answers_to_lines([True] * 30)))

    def test_other_staircases_keep_their_traces_beside_it(self):
        rng = random.Random(8)
        answers = [rng.random() < 0.5 for _ in range(200)]
        staircase, reference = Conversation.STAIRCASE, Paper(175, 50)
        code, events, stderr = heft(toml([self.constant(), staircase]), answers_to_lines(answers))
        self.assertEqual((code, stderr, events[-1]), (0, "", {"event": "done"}))
        for trial, answer in zip(only(events, "trial"), answers):
            if trial["staircase"] == "15g":
                self.assertEqual(trial["level"], reference.level)
                reference.answer(answer)
        self.assertTrue(reference.finished)


class ThreeWayAnswers(unittest.TestCase):
    def test_any_choice_is_a_positive_response(self):
        rng = random.Random(6)
        choices = [rng.choice(["comparison", "reference", "none"]) for _ in range(200)]
        lines = "".join(json.dumps({"answer": c}) + "\n" for c in choices).encode()
        procedure = toml([Conversation.STAIRCASE])
        self.assertEqual(heft(procedure, lines)[1],
                         heft(procedure, answers_to_lines([c != "none" for c in choices]))[1])

    def test_what_is_no_choice_is_refused_with_the_three(self):
        for line in (b'{"answer":"heavier"}', b'{"answer":true}', b'{"answer":null}'):
            events = heft(toml([Conversation.STAIRCASE]), line)[1]
            [error] = only(events, "error")
            for word in ('"answer" must be', '"comparison"', '"reference"', '"none"'):
                self.assertIn(word, error["message"])
            self.assertEqual(len(only(events, "trial")), 1)


class Refusals(unittest.TestCase):
    def test_constant_levels_that_can_not_be(self):
        for keys, place in ((dict(levels=[1, 2, 1]), ":4:17"), (dict(n_per_level=0), ":5:15"),
                            (dict(n_per_level=4000), ":5:15"), (dict(levels=[]), ":4:10")):
            code, events, stderr = heft(toml([ConstantStimuli().constant(**keys)]), b"")
            self.assertEqual((code, events), (3, []))
            self.assertIn(place, stderr)

    def test_broken_file(self):
        code, events, stderr = heft('[[staircase]]\nname = "s"\nstart = "high"\nstep = 0\n', b"")
        self.assertEqual((code, events), (3, []))
        self.assertIn(":3:", stderr)
        self.assertIn(":4:", stderr)

    def test_missing_file_and_missing_argument(self):
        missing = subprocess.run(command("no/such.toml"), capture_output=True)
        self.assertEqual((missing.returncode, missing.stdout), (1, b""))
        self.assertIn(b"no/such.toml", missing.stderr)
        self.assertEqual(subprocess.run(command(), capture_output=True).returncode, 2)

    def test_output_that_can_not_be_written(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(toml([Conversation.STAIRCASE]))
            file.flush()
            with open("/dev/full", "w") as full:
                run = subprocess.run(command(file.name), stdin=subprocess.DEVNULL,
                                     stdout=full, stderr=subprocess.PIPE, timeout=60)
            self.assertEqual(run.returncode, 1)
            self.assertIn(b"cannot write", run.stderr)
            with subprocess.Popen(command(file.name), stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE) as talk:
                talk.stdout.readline()
                talk.stdout.close()  # the reader goes
                talk.stdin.write(b'{"response":true}\n')
                talk.stdin.flush()
                message = talk.stderr.read()
            self.assertEqual(talk.returncode, 1)
            self.assertEqual(message.count(b"\n"), 1)


class Garbage(unittest.TestCase):
    def test_every_line_gets_its_answer(self):
        rng = random.Random(2024)
        lines = [mutated(rng) for _ in range(8000)] + EXTREMES + [b'{"response":true}']
        procedure = toml([dict(name='quote " and \\ and \u00e9', start=1, step=1, min_trials=90000,
                               stop_trials=100000)])
        code, events, stderr = heft(procedure, b"\n".join(lines))
        self.assertEqual((code, stderr), (0, ""))
        expected = [(number, understood(line)) for number, line in enumerate(lines, 1)
                    if line.strip(b" \t\r")]
        kinds = [kind for _, kind in expected]
        self.assertGreater(min(kinds.count("answer"), kinds.count("void")), 100)
        self.assertEqual([e["line"] for e in only(events, "error")],
                         [number for number, kind in expected if kind == "error"])
        self.assertEqual(len(only(events, "trial")), 1 + len(kinds) - kinds.count("error"))


if __name__ == "__main__":
    procedure_harness.program = sys.argv.pop(1)
    unittest.main()

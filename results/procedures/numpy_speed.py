"""Time of a Psi trial by heft's Python module and by plain numpy, in one run: the same likelihood table,
posterior and expected entropy (Kontsevich & Tyler 1999, eq. 3), which must choose the same levels.

Run: PYTHONPATH=build/python python3 results/procedures/numpy_speed.py [TRIALS]
"""
import math
import random
import statistics
import sys
import time

import heft
import numpy

# Numbers of levels, thresholds, slopes and lapse rates.
GRIDS = [(40, 30, 10, 3), (100, 50, 50, 50)]


class NumpyPsi:
    def __init__(self, levels, thresholds, slopes, lapses):
        self.levels = levels
        x = levels[:, None, None, None]
        z = (x - thresholds[:, None, None]) / slopes[:, None]
        cdf = numpy.vectorize(math.erf)(z / math.sqrt(2)) / 2 + 0.5
        self.positive = ((1 - lapses) * cdf).reshape(len(levels), -1)
        n_points = self.positive.shape[1]
        self.posterior = numpy.full(n_points, 1 / n_points)

    def entropies(self):
        """Expected after a trial at each level."""
        total = numpy.zeros(len(self.levels))
        for likelihood in (self.positive, 1 - self.positive):
            joint = likelihood * self.posterior
            share = joint.sum(axis=1)
            after = joint / share[:, None]
            logs = numpy.log(after, out=numpy.zeros_like(after), where=after > 0)
            total -= share * (after * logs).sum(axis=1)
        return total

    def respond(self, level, positive):
        row = self.positive[numpy.argmin(abs(self.levels - level))]
        self.posterior = self.posterior * (row if positive else 1 - row)
        self.posterior /= self.posterior.sum()


def ratios(low, high, n):
    return low * (high / low) ** (numpy.arange(n) / (n - 1))


def seconds_of(call):
    started = time.perf_counter()
    call()
    return time.perf_counter() - started


def heft_psi(levels, thresholds, slopes, lapses, n_trials):
    return heft.Procedure({"name": "s", "kind": "psi", "function": "cumulative_normal",
                           "levels": levels.tolist(), "threshold": thresholds.tolist(),
                           "slope": slopes.tolist(), "guess": 0, "lapse": lapses.tolist(),
                           "stop_trials": n_trials})


class Trial:
    """An update and the next level: seconds of each program."""

    def __init__(self, level, positive, heft_s):
        self.level, self.positive, self.heft_s, self.numpy_s = level, positive, heft_s, 0.0


def run(ours, after_trial):
    rng, started, trials = random.Random(1), time.perf_counter(), []
    for asked in ours:
        heft_s = time.perf_counter() - started
        trials.append(Trial(asked.level, rng.gauss(150, 30) < asked.level, heft_s))
        after_trial(trials[-1])
        started = time.perf_counter()
        asked.answer(trials[-1].positive)
    return trials


def compare(sizes, n_trials):
    n_levels, n_thresholds, n_slopes, n_lapses = sizes
    levels = numpy.linspace(0, 400, n_levels)
    thresholds = numpy.linspace(5, 395, n_thresholds)
    slopes, lapses = ratios(5, 160, n_slopes), numpy.linspace(0, 0.1, n_lapses)
    largest_loss = 0.0

    def by_numpy(plain, trial):
        nonlocal largest_loss
        entropies = []
        trial.numpy_s = seconds_of(lambda: entropies.append(plain.entropies()))
        chosen = entropies[0][numpy.argmin(abs(levels - trial.level))]
        largest_loss = max(largest_loss, chosen - entropies[0].min())
        trial.numpy_s += seconds_of(lambda: plain.respond(trial.level, trial.positive))

    def heft_afresh():
        return heft_psi(levels, thresholds, slopes, lapses, n_trials)

    plain = NumpyPsi(levels, thresholds, slopes, lapses)
    apart = run(heft_afresh(), lambda trial: None)
    for trial in apart:
        by_numpy(plain, trial)
    plain = NumpyPsi(levels, thresholds, slopes, lapses)
    in_turns = run(heft_afresh(), lambda trial: by_numpy(plain, trial))
    print(f"{n_thresholds * n_slopes * n_lapses} points, {n_levels} levels, {n_trials} trials:")
    for how, trials in (("one program after the other", apart), ("trial by trial in turns", in_turns)):
        del trials[0]  # its level comes without an update
        heft_ms = 1e3 * statistics.median(trial.heft_s for trial in trials)
        numpy_ms = 1e3 * statistics.median(trial.numpy_s for trial in trials)
        print(f"  {how}: heft {heft_ms:.2g} ms a trial, numpy {numpy_ms:.2g} ms, "
              f"ratio {numpy_ms / heft_ms:.0f}")
    print(f"  levels of heft have an expected entropy within {largest_loss:.1g} of the least")


if __name__ == "__main__":
    for sizes in GRIDS:
        compare(sizes, int(sys.argv[1]) if len(sys.argv) > 1 else 40)

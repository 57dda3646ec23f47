"""Time of a Psi trial by heft's Python module and by plain numpy, in one run: the same likelihood table,
posterior and expected entropy (Kontsevich & Tyler 1999, eq. 3), which must choose the same levels.

Run: PYTHONPATH=build/python python3 results/procedures/numpy_speed.py [TRIALS]
"""
import math
import random
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


def compare(sizes, n_trials):
    n_levels, n_thresholds, n_slopes, n_lapses = sizes
    levels = numpy.linspace(0, 400, n_levels)
    thresholds = numpy.linspace(5, 395, n_thresholds)
    slopes, lapses = ratios(5, 160, n_slopes), numpy.linspace(0, 0.1, n_lapses)
    plain = NumpyPsi(levels, thresholds, slopes, lapses)
    ours = heft.Procedure({"name": "s", "kind": "psi", "function": "cumulative_normal",
                           "levels": levels.tolist(), "threshold": thresholds.tolist(),
                           "slope": slopes.tolist(), "guess": 0, "lapse": lapses.tolist(),
                           "stop_trials": n_trials})
    rng = random.Random(1)
    heft_s, numpy_s, largest_loss = [], [], 0.0
    started = time.perf_counter()
    for trial in ours:
        heft_s.append(time.perf_counter() - started)
        started = time.perf_counter()
        entropies = plain.entropies()
        numpy_s.append(time.perf_counter() - started)
        chosen = entropies[numpy.argmin(abs(levels - trial.level))]
        largest_loss = max(largest_loss, chosen - entropies.min())
        positive = rng.gauss(150, 30) < trial.level
        started = time.perf_counter()
        plain.respond(trial.level, positive)
        numpy_s[-1] += time.perf_counter() - started
        started = time.perf_counter()
        trial.answer(positive)
    median = sorted(a / b for a, b in zip(numpy_s[1:], heft_s[1:]))[(n_trials - 1) // 2]
    print(f"{n_thresholds * n_slopes * n_lapses} points, {n_levels} levels: {n_trials} trials, heft "
          f"{1e6 * sum(heft_s[1:]) / (n_trials - 1):.0f} us a trial, numpy "
          f"{1e6 * sum(numpy_s[1:]) / (n_trials - 1):.0f} us, median ratio {median:.0f}; levels of heft "
          f"have an expected entropy within {largest_loss:.1g} of the least")


if __name__ == "__main__":
    for sizes in GRIDS:
        compare(sizes, int(sys.argv[1]) if len(sys.argv) > 1 else 40)

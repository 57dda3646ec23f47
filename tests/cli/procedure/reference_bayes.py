"""Bayesian procedures written from their papers in plain Python, to compare with `heft procedure`.

QUEST: Watson & Pelli 1983, by the formulas of QuestCreate, QuestUpdate and QuestQuantile.
QUEST+ and Psi: Watson 2017; Kontsevich & Tyler 1999; Prins 2013. Every probability is computed again
from all trials, and every entropy from the definition.
"""
import bisect
import itertools
import math


def phi(z):
    return math.erfc(-z / math.sqrt(2)) / 2


def interpolated(p, cumulative, values):
    """numpy.interp"""
    if p <= cumulative[0]:
        return values[0]
    i = bisect.bisect_left(cumulative, p)
    if i >= len(values):
        return values[-1]
    share = (p - cumulative[i - 1]) / (cumulative[i] - cumulative[i - 1])
    return values[i - 1] + share * (values[i] - values[i - 1])


def summary(values, weights, mode):
    mean = math.fsum(v * w for v, w in zip(values, weights))
    sd = math.sqrt(math.fsum((v - mean) ** 2 * w for v, w in zip(values, weights)))
    cumulative = list(itertools.accumulate(weights))
    return {"mean": mean, "sd": sd, "mode": mode, "low": interpolated(0.025, cumulative, values),
            "high": interpolated(0.975, cumulative, values)}


def normalized(logs):
    largest = max(logs)
    weights = [math.exp(value - largest) for value in logs]
    total = math.fsum(weights)
    return [weight / total for weight in weights]


def log(p):
    return math.log(max(p, 2.2250738585072014e-308))


def curve(function, scale, x, t, s):
    """Probability of an attentive positive response (Watson 2017, and the usual definitions)."""
    if function == "weibull":
        if scale == "linear":
            return 1 - math.exp(-(x / t) ** s)
        return 1 - math.exp(-10 ** (s * (x - t) / (1 if scale == "log10" else 20)))
    u = (x - t) / s
    if function == "cumulative_normal":
        return phi(u)
    if function == "logistic":
        return 1 / (1 + math.exp(-u))
    return 1 - math.exp(-math.exp(u))


def outcomes(function, scale, parameters, x):
    """{answer: probability}"""
    if function == "indecision":
        sensitivity, indecision, bias, lapse = parameters
        mean = sensitivity * x + bias
        comparison, reference = phi(mean - indecision), phi(-mean - indecision)
        shares = {"reference": reference, "comparison": comparison,
                  "none": phi(indecision - mean) - reference}
        return {k: lapse / 3 + (1 - lapse) * p for k, p in shares.items()}
    threshold, slope, guess, lapse = parameters
    p = guess + (1 - guess - lapse) * curve(function, scale, x, threshold, slope)
    return {True: p, False: 1 - p}


class LeastEntropy:
    def __init__(self, function, scale, levels, grids, nuisance=()):
        self.model = function, scale
        self.levels, self.names, self.grids = levels, list(grids), list(grids.values())
        self.interest = [i for i, name in enumerate(self.names) if name not in nuisance]
        self.points = list(itertools.product(*self.grids))
        self.logs = [0.0] * len(self.points)
        self.table = [[outcomes(*self.model, point, x) for x in levels] for point in self.points]

    def answer(self, level, answer):
        for i, point in enumerate(self.points):
            self.logs[i] += log(outcomes(*self.model, point, level)[answer])

    def marginal(self, weights, axes):
        sums = {}
        for point, weight in zip(self.points, weights):
            key = tuple(point[axis] for axis in axes)
            sums[key] = sums.get(key, 0) + weight
        return sums

    def expected_entropy(self, k, weights):
        expected = 0
        for answer in self.table[0][k]:
            joint = [w * row[k][answer] for w, row in zip(weights, self.table)]
            p = math.fsum(joint)
            if p <= 0:
                continue
            after = self.marginal([value / p for value in joint], self.interest).values()
            expected -= p * math.fsum(q * math.log(q) for q in after if q > 0)
        return expected

    def expected_entropies(self):
        weights = normalized(self.logs)
        return [self.expected_entropy(k, weights) for k in range(len(self.levels))]

    def posterior(self):
        weights = normalized(self.logs)
        best = [p for p, w in zip(self.points, weights) if w > max(weights) * (1 - 1e-9)]
        parameters = {name: summary(self.grids[i], list(self.marginal(weights, [i]).values()),
                                    best[0][i]) for i, name in enumerate(self.names)}
        if len(best) > 1:  # of equally probable points any may be the mode
            for numbers in parameters.values():
                del numbers["mode"]
        return parameters


class Quest:
    def __init__(self, guess, sd, p, beta, delta, gamma, grain, n):
        """n: grains on each side of the guess"""
        self.guess, self.grain, self.n = guess, grain, n
        self.x = [i * grain for i in range(-n, n + 1)]
        self.logs = [-0.5 * (x / sd) ** 2 for x in self.x]

        def share(x):
            return delta * gamma + (1 - delta) * (1 - (1 - gamma) * math.exp(-10 ** (beta * x)))
        table = [(share(i * grain), i * grain) for i in range(-2 * n, 2 * n + 1)]
        strict = [b for b, c in zip(table, table[1:]) if c[0] != b[0]]
        self.shift = interpolated(p, [b[0] for b in strict], [b[1] for b in strict])
        self.share = lambda x: share(x + self.shift)
        low, high = self.share(-2 * n * grain), self.share(2 * n * grain)
        eps = 1e-14
        gain = (high * math.log(high + eps) - low * math.log(low + eps)
                + (1 - high + eps) * math.log(1 - high + eps)
                - (1 - low + eps) * math.log(1 - low + eps))
        self.order = (1 / (1 + math.exp(gain / (low - high))) - low) / (high - low)

    def answer(self, level, answer):
        r = (level - self.guess) / self.grain
        nearest = max(-self.n, min(self.n, math.floor(abs(r) + 0.5) * (1 if r > 0 else -1)))
        for k in range(2 * self.n + 1):
            p = self.share((nearest - (k - self.n)) * self.grain)
            self.logs[k] += log(p if answer else 1 - p)

    def level(self, placement):
        weights = normalized(self.logs)
        if placement == "quantile":
            cumulative = list(itertools.accumulate(weights))
            return self.guess + interpolated(self.order * cumulative[-1], cumulative, self.x)
        if placement == "mode":
            return self.guess + self.x[weights.index(max(weights))]
        return self.guess + math.fsum(x * w for x, w in zip(self.x, weights))

    def posterior(self):
        weights = normalized(self.logs)
        values = [self.guess + x for x in self.x]
        return {"threshold": summary(values, weights, values[weights.index(max(weights))])}

"""Makes the golden fits beside this file: answers of made-up people, and what SciPy (psychometric
functions) and R's ordinal::clm (indecision) find in them.

Run: python3 tests/golden/fit/make.py        Debian: python3-scipy, r-cran-ordinal
"""
import csv
import json
from pathlib import Path

import numpy

import others

HERE = Path(__file__).resolve().parent
SCALES = {"linear": ((1, 20), (6, 14), (1, 4)), "log10": ((0, 1.5), (0.4, 1.1), (1.5, 5)),
          "db": ((-30, 0), (-20, -8), (1.5, 5))}  # levels, thresholds, slopes
SETTINGS = [("cumulative_normal", "linear", 0, 0), ("cumulative_normal", "linear", 0.5, 0.02),
            ("cumulative_normal", "linear", None, None), ("logistic", "linear", 0, 0),
            ("logistic", "linear", 0, None), ("weibull", "linear", 0.5, 0.02),
            ("weibull", "linear", 0.5, None), ("weibull", "log10", 0.5, 0.01),
            ("weibull", "db", 0, 0), ("weibull", "db", 0.5, None), ("gumbel", "linear", 0, 0),
            ("gumbel", "linear", None, 0.02)]
SETTINGS = [dict(zip(("function", "scale", "guess", "lapse"), values)) for values in SETTINGS]


def name_of(setting):
    share = lambda value: "free" if value is None else str(value)
    return "_".join([setting["function"], setting["scale"], "guess", share(setting["guess"]),
                     "lapse", share(setting["lapse"])])


def arguments_of(setting):
    """Of heft fit."""
    words = ["--model", "psychometric", "--by", "dataset", "--json"]
    for option, value in setting.items():
        words += [f"--{option}", "free" if value is None else str(value)]
    return words


def made_up_answers(setting, rng, few):
    """-> levels, n_positive, n; few: with so few trials that much goes wrong"""
    span, thresholds, slopes = SCALES[setting["scale"]]
    n_levels = rng.integers(3, 6) if few else rng.integers(7, 11)
    x = numpy.sort(rng.uniform(*span, n_levels)).round(3)
    n = rng.integers(1, 8, n_levels) if few else rng.integers(30, 90, n_levels)
    chance = lambda fixed, most: rng.uniform(0.03, most) if fixed is None else fixed
    truth = [rng.uniform(*thresholds), rng.uniform(*slopes), chance(setting["guess"], 0.3),
             chance(setting["lapse"], 0.12)]
    yes, _ = others.probabilities(setting, x, truth)
    return x, rng.binomial(n, yes), n


def write_answers(path, datasets):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["dataset", "x", "n_positive", "n"])
        for name, (x, n_positive, n) in datasets.items():
            writer.writerows([name, float(a), int(b), int(c)] for a, b, c in zip(x, n_positive, n))


def write_choices(path, rng, n_datasets):
    """Choices of people with three answers; some of them feel nothing, some have few trials."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["dataset", "level_g", "answer"])
        n_written = 0
        while n_written < n_datasets:
            n = int(rng.choice([16, 60, 150, 300]))
            levels = rng.uniform(-300 if n_written % 2 else 0, 300, rng.integers(3, 10)).round(1)
            sensitivity, tau = rng.choice([0, 0.004, 0.01, 0.02]), rng.uniform(0.2, 1.5)
            shown = rng.choice(levels, n)
            felt = sensitivity * shown + rng.normal(0, 0.3) + rng.normal(size=n)
            answers = numpy.where(felt > tau, "comparison",
                                  numpy.where(felt < -tau, "reference", "none"))
            if len(set(answers)) < 3:  # clm has no third answer then
                continue
            writer.writerows([f"d{n_written}", float(x), a] for x, a in zip(shown, answers))
            n_written += 1


def write_peoples_choices(path, rng, n_people):
    """40 choices each of people whose sensitivities and biases differ."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["person", "level_g", "answer"])
        for person in range(n_people):
            shown = rng.choice([-450, -300, -150, -75, 0, 75, 150, 300, 450], 40)
            sensitivity, bias = 0.0045 * numpy.exp(rng.normal(0, 0.3)), rng.normal(0, 0.2)
            felt = sensitivity * shown + bias + rng.normal(size=40)
            answers = numpy.where(felt > 1, "comparison", numpy.where(felt < -1, "reference", "none"))
            writer.writerows([f"p{person}", x, answer] for x, answer in zip(shown, answers))


def fitted(setting, data):
    parameters, log_likelihood, errors = others.scipy_fit(setting, data)
    names = ("threshold", "slope", "guess", "lapse")
    result = {"log_likelihood": log_likelihood, "value": dict(zip(names, parameters)),
              "se": dict(zip(names, errors or [None] * 4))}
    if setting["guess"] == 0 and setting["lapse"] == 0:
        result["interval"] = {names[i]: others.scipy_interval(setting, data, i, parameters,
                                                              log_likelihood) for i in (0, 1)}
    return result


def main():
    rng = numpy.random.default_rng(20)
    golden = []
    for setting in SETTINGS:
        datasets = {f"d{i}": made_up_answers(setting, rng, few=i >= 5) for i in range(8)}
        write_answers(HERE / (name_of(setting) + ".csv"), datasets)
        golden.append({"file": name_of(setting) + ".csv", "arguments": arguments_of(setting),
                       "fits": {name: fitted(setting, data) for name, data in datasets.items()}})
    write_choices(HERE / "indecision.csv", rng, 16)
    with open(HERE / "psychometric.json", "w") as file:
        json.dump(golden, file, indent=1)
        file.write("\n")
    with open(HERE / "indecision.json", "w") as file:
        fits = others.clm_fits(HERE / "indecision.csv")
        for fit in fits.values():
            del fit["seconds"]
        json.dump(fits, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()

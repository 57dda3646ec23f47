"""Compares heft fit with SciPy and R's ordinal::clm and clmm on new random data: figures and time.
Exits with 77 where these are not installed (Debian: python3-scipy, r-cran-ordinal).

Run: python3 tests/cli/fit/fit_against_others.py PATH_TO_HEFT [SEED [DATASETS]]
"""
import csv
import importlib.util
import os
import resource
import secrets
import sys
import tempfile
import warnings
from pathlib import Path

import fit_harness
from fit_harness import choice_differences, differences, fits, interval_differences

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "golden" / "fit"))
sys.dont_write_bytecode = True
warnings.filterwarnings("ignore")
DEBIANS = "/usr/bin/python3"  # whose packages are Debian's


def psychometric(folder, rng, n_datasets):
    """-> how many fits differ"""
    n_fits = n_thresholds = n_wrong = 0
    for setting in make.SETTINGS:
        sets = {f"d{i}": make.made_up_answers(setting, rng, few=i % 2) for i in range(n_datasets)}
        make.write_answers(folder / "data.csv", sets)
        for fit in fits(folder / "data.csv", *make.arguments_of(setting)):
            expected = make.fitted(setting, sets[fit["group"]])
            few = int(fit["group"][1:]) % 2  # SciPy's profiles are local
            wrong = differences(fit, expected) + (
                [] if few else interval_differences(fit, expected.get("interval", {})))
            n_fits, n_thresholds = n_fits + 1, n_thresholds + fit["identifiable"]
            n_wrong += bool(wrong)
            if wrong:
                print(make.name_of(setting), [list(map(float, x)) for x in sets[fit["group"]]], *wrong)
    print(f"psychometric: {n_fits} fits, {n_thresholds} with a threshold, {n_wrong} differ")
    return n_wrong


def timed(run):
    """-> the result, and the processor time of the programs that it ran"""
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    before = used()
    return run(), used() - before


def is_a_splines(what, fit, path):
    """-> whether an end that differs from clm's, which come from a spline, is where the likelihood ends"""
    end = what.split()[0]
    if end not in ("low", "high"):
        return False
    answers = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["dataset"] == fit["group"]:
                counts = answers.setdefault(float(row["level_g"]), [0, 0, 0])
                counts[("reference", "none", "comparison").index(row["answer"])] += 1
    at = fit["parameters"]["sensitivity"][end]
    return abs(others.fall_of_choices(answers, at, fit["log_likelihood"]) - 3.8415) < 1e-3


def indecision(folder, rng, n_datasets):
    """-> how many fits differ"""
    make.write_choices(folder / "data.csv", rng, n_datasets)
    _, start_s = timed(lambda: fit_harness.run("--help"))
    found, ours_s = timed(lambda: fits(folder / "data.csv", "--model", "indecision", "--by", "dataset"))
    expected, r_s = timed(lambda: others.clm_fits(folder / "data.csv"))
    n_wrong = 0
    for fit in found:
        wrong = [what for what in choice_differences(fit, expected[fit["group"]])
                 if not is_a_splines(what, fit, folder / "data.csv")]
        n_wrong += bool(wrong)
        if wrong:
            print(fit["group"], *wrong)
    r_fits_s = sum(fit["seconds"] for fit in expected.values())
    print(f"indecision: {len(found)} fits, {n_wrong} differ; processor time: heft {ours_s:.3f} s, of which its start "
          f"{start_s:.3f} s; R {r_s:.2f} s, of which clm and confint {r_fits_s:.2f} s: "
          f"{r_fits_s / ours_s:.0f} times as long as heft, {r_fits_s / max(ours_s - start_s, 1e-3):.0f} "
          "times without its start")
    return n_wrong


def mixed(folder, rng):
    """-> how many fits differ: clmm has normal sensitivities, no lapses and one criterion for all, so
    that its sensitivity need only lie in the interval"""
    n_wrong = 0
    for n_people in (13, 40, 100):
        make.write_peoples_choices(folder / "people.csv", rng, n_people)
        found, ours_s = timed(lambda: fits(folder / "people.csv", "--model", "indecision",
                                           "--person", "person"))
        sensitivity = found[0]["parameters"]["sensitivity"]
        (_, one_s), (theirs, two_s) = others.clmm_fits(folder / "people.csv")
        is_wrong = not sensitivity["low"] <= theirs <= sensitivity["high"]
        n_wrong += is_wrong
        print(f"mixed, {n_people} people: {'differs' if is_wrong else 'agrees'}; processor time: heft "
              f"{ours_s:.3f} s with intervals; clmm without them {one_s:.2f} s where sensitivities "
              f"vary ({one_s / ours_s:.0f} times as long), {two_s:.2f} s where biases do, too "
              f"({two_s / ours_s:.0f} times)")
    return n_wrong


if __name__ == "__main__":
    if importlib.util.find_spec("scipy") is None and sys.executable != DEBIANS:
        os.execv(DEBIANS, [DEBIANS, *sys.argv])  # another Python stands before it
    try:
        import make
        import numpy
        import others
    except ImportError as missing:
        print(f"not run: {missing}")
        sys.exit(77)
    if not others.have_r():
        print("not run: R's package ordinal is not installed")
        sys.exit(77)
    fit_harness.program = sys.argv[1]
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else secrets.randbelow(2**31)
    print(f"seed {seed}")
    generator = numpy.random.default_rng(seed)
    n_sets = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    with tempfile.TemporaryDirectory() as name:
        sys.exit(min(1, psychometric(Path(name), generator, n_sets) +
                     indecision(Path(name), generator, 10 * n_sets) +
                     mixed(Path(name), generator)))

"""heft fit beside SciPy and R's ordinal::clm on fresh random data: the same figures, and how long
each takes. Exits 77 where these are not installed (Debian: python3-scipy, r-cran-ordinal).

Run: python3 tests/cli/fit_against_others.py PATH_TO_HEFT [SEED [DATASETS]]
"""
import importlib.util
import os
import sys
import tempfile
import time
import warnings
from pathlib import Path

import fit_harness
from fit_harness import choice_differences, differences, fits, interval_differences

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "golden" / "fit"))
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


def indecision(folder, rng, n_datasets):
    """-> how many fits differ"""
    make.write_choices(folder / "data.csv", rng, n_datasets)
    started = time.perf_counter()
    found = fits(folder / "data.csv", "--model", "indecision", "--by", "dataset")
    ours_s = time.perf_counter() - started
    started = time.perf_counter()
    expected = others.clm_fits(folder / "data.csv")
    r_s = time.perf_counter() - started
    n_wrong = 0
    for fit in found:
        wrong = choice_differences(fit, expected[fit["group"]])
        n_wrong += bool(wrong)
        if wrong:
            print(fit["group"], *wrong)
    print(f"indecision: {len(found)} fits, {n_wrong} differ; heft {ours_s:.2f} s, R {r_s:.2f} s, "
          f"of which clm and confint {sum(fit['seconds'] for fit in expected.values()):.2f} s")
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
    generator = numpy.random.default_rng(int(sys.argv[2]) if len(sys.argv) > 2 else None)
    n_sets = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    with tempfile.TemporaryDirectory() as name:
        sys.exit(min(1, psychometric(Path(name), generator, n_sets) +
                     indecision(Path(name), generator, 10 * n_sets)))

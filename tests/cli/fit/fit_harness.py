"""Runs `heft fit` and compares its figures with those of other programs (tests/golden/fit)."""
import json
import subprocess

program = "heft"  # path, set by the test's main


def run(*words):
    return subprocess.run([program, "fit", *map(str, words)], capture_output=True, timeout=600)


def fits(*words):
    """-> the list that --json gives"""
    done = run(*words, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def is_near(value, expected, tolerance, least=0):
    return value is not None and abs(value - expected) <= tolerance * max(abs(expected), least)


def differences(fit, expected, log_likelihood=1e-6, value=1e-4, se=0.02):
    """What a psychometric fit has else than SciPy found. -> list of texts"""
    gained = fit["log_likelihood"] - expected["log_likelihood"]
    if gained < -log_likelihood:
        return [f"log likelihood {gained} below"]
    if not fit["identifiable"]:
        found = [p["value"] for p in fit["parameters"].values() if not p["fixed"]]
        return [] if fit["why"] and found.count(None) == len(found) else ["figures without a threshold"]
    if gained > log_likelihood:
        return []  # SciPy ended elsewhere
    wrong = []
    for name, parameter in fit["parameters"].items():
        if not is_near(parameter["value"], expected["value"][name], value, least=0.1):
            wrong.append(f"{name} {parameter['value']}, {expected['value'][name]}")
        if parameter["se"] and expected["se"][name] and \
                not is_near(parameter["se"], expected["se"][name], se):
            wrong.append(f"SE of {name} {parameter['se']}, {expected['se'][name]}")
    return wrong


def interval_differences(fit, intervals, tolerance=1e-3):
    """Of intervals that end on both sides."""
    wrong = []
    for name, ends in intervals.items():
        for end, expected in zip(("low", "high"), ends):
            value = fit["parameters"][name][end]
            if fit["identifiable"] and expected and value and not is_near(value, expected, tolerance):
                wrong.append(f"{name} {end} {value}, {expected}")
    return wrong


def choice_differences(fit, expected):
    """What a fit of choices has else than clm found. -> list of texts"""
    parameters, gained = fit["parameters"], fit["log_likelihood"] - expected["log_likelihood"]
    if abs(gained) > 1e-5:
        return [f"log likelihood off by {gained}"]
    sensitivity = parameters["sensitivity"]
    if expected["sensitivity_se"] is None:  # it, or a criterion, ran off to infinity
        if sensitivity["value"] is None or is_near(sensitivity["value"], expected["sensitivity"], 1e-3):
            return []
        return ["a sensitivity in spite of separation"]
    unit = expected["sensitivity_se"]
    wrong = [f"{name} {parameters[name]['value']}, {expected[name]}"
             for name in ("sensitivity", "indecision", "bias")
             if not is_near(parameters[name]["value"], expected[name], 1e-3,
                            least=unit if name == "sensitivity" else 0.1)]
    if not is_near(sensitivity["se"], unit, 0.02):
        wrong.append(f"SE {sensitivity['se']}, {unit}")
    for end in ("low", "high"):  # clm's come from a spline through a few points
        if expected[end] is not None and abs(sensitivity[end] - expected[end]) > 0.05 * unit:
            wrong.append(f"{end} {sensitivity[end]}, {expected[end]}")
    return wrong

"""How often printed 95 % intervals hold the truth, over made-up studies: runs the coverage tests of
test_inference and test_analysis at length, or reads what they printed, and writes coverage.csv beside
this file.

Run: python3 results/coverage/measure.py FOLDER_OF_TEST_PROGRAMS [STUDIES | FILE_WITH_THEIR_OUTPUT COMMIT]
"""
import csv
import os
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
NUMBER = r"([\d.]+)"
PEOPLE, SET = r"^(?P<row>\d+ people, threshold .*, spread [\d.]+)", r"(?P<more>[\d.]+)"
FIGURES = [  # what a line says: kind, pattern
    ("share, mean over people", rf"^(?P<row>.* share .*): {NUMBER} % \(mean\)"),
    ("share, ratio", rf"^(?P<row>.* share .*): .*, {NUMBER} % \(ratio\)"),
    ("threshold", rf"{PEOPLE}: {NUMBER} % of .*; indecision {SET}: {NUMBER} %; of each person {NUMBER} %"),
    ("ratio of thresholds", rf"^ratio of thresholds (?P<row>.*): {NUMBER} %"),
    ("log-normal mean", rf"^(?P<row>\d+ people, log SD .*): {NUMBER} %"),
    ("Tobit mean", rf"^(?P<row>\d+ people, ceiling .*): {NUMBER} %"),
    ("perceived mass", rf"^(?P<row>\d+ people, perceived mass .*?): {NUMBER} %"),
    ("perceived mass contrast", rf"^(?P<row>\d+ people, perceived masses .*?): {NUMBER} %"),
    ("perceived distance", rf"^(?P<row>\d+ people, perceived mass .*?): .*lighter {NUMBER} %"),
    ("above - below", rf"^(?P<row>\d+ people, .*above - below .*): {NUMBER} % of"),
]


def said(folder, studies):
    return "".join(
        subprocess.run([Path(folder) / program, "--gtest_filter=CoverageOf.*"], capture_output=True,
                       text=True, env={**os.environ, "HEFT_STUDIES": str(studies)}).stdout
        for program in ("test_inference", "test_analysis"))


def rows_of(kind, found):
    if kind != "threshold":
        return [(kind, found["row"], float(found.groups()[-1]))]
    row, threshold, more, indecision, own = found.groups()
    row += f", indecision {more}"
    return [("threshold", row, float(threshold)), ("indecision", row, float(indecision)),
            ("each person's threshold", row, float(own))]


def main():
    folder, what = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "400"
    lines = (said(folder, what) if what.isdigit() else Path(what).read_text()).splitlines()
    studies = what if what.isdigit() else "400"
    commit = sys.argv[3] if len(sys.argv) > 3 else subprocess.run(
        ["git", "rev-parse", "--short", "HEAD"], cwd=HERE, capture_output=True, text=True).stdout.strip()
    command = f"python3 results/coverage/measure.py build/tests {studies}"
    rows = []
    for line in lines:
        for kind, pattern in FIGURES:
            if found := re.match(pattern, line):
                rows += rows_of(kind, found)
    with open(HERE / "coverage.csv", "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["interval", "study", "holds_percent", "studies", "commit", "command"])
        table.writerows([*row, studies, commit, command] for row in rows)
    for kind in dict.fromkeys(kind for kind, _, _ in rows):
        held = sorted((percent, row) for one, row, percent in rows if one == kind)
        if held:
            print(f"{kind}: {len(held)} rows, {held[0][0]:.1f} to {held[-1][0]:.1f} %; lowest: {held[0][1]}")


if __name__ == "__main__":
    main()

"""Errors of thresholds by the paper's staircase and by Psi in as many trials, and the time that a level
takes: runs the efficiency test of test_psychophysics at length and writes procedures.csv beside this file.

Run: python3 results/procedures/measure.py FOLDER_OF_TEST_PROGRAMS [PEOPLE]
"""
import csv
import os
import re
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
COLUMNS = ["reference_g", "criterion_sd", "staircases", "trials_each", "people", "jnd", "jnd_of_noticed",
           "people_with_noticed", "people_without_jnd", "refit", "psi"]
NUMBER = r"([\d.]+|nan)"
ROW = re.compile(rf"^{NUMBER} g, criterion {NUMBER} SD, {NUMBER} staircases of {NUMBER} trials, {NUMBER} "
                 rf"people: JND {NUMBER}, JND of noticed {NUMBER} \({NUMBER} people, {NUMBER} without\), "
                 rf"refit {NUMBER}, psi {NUMBER}$")


def main():
    folder, people = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "300"
    said = subprocess.run([Path(folder) / "test_psychophysics", "--gtest_filter=Efficiency.*"],
                          capture_output=True, text=True, check=True,
                          env={**os.environ, "HEFT_PEOPLE": people}).stdout.splitlines()
    rows = [found.groups() for line in said if (found := ROW.match(line))]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=HERE, capture_output=True,
                            text=True, check=True).stdout.strip()
    command = f"python3 results/procedures/measure.py build/tests {people}"
    with open(HERE / "procedures.csv", "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow([*COLUMNS, "commit", "command"])
        table.writerows([*row, commit, command] for row in rows)
    figures = [dict(zip(COLUMNS, map(float, row))) for row in rows]
    for staircases in sorted({row["staircases"] for row in figures}):
        of_number = [row for row in figures if row["staircases"] == staircases]
        for other in ("jnd", "refit"):
            ratios = [row["psi"] / row[other] for row in of_number]
            print(f"{staircases:g} staircases: psi / {other}: median {statistics.median(ratios):.2f}, "
                  f"{min(ratios):.2f} to {max(ratios):.2f}")
    print(*(line for line in said if "next level" in line), sep="\n")


if __name__ == "__main__":
    main()

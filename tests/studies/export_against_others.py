"""Exports compared with other programs, if these are installed: bids-validator (npm) accepts the
BIDS dataset; R with lme4 and ordinal runs analysis.R, and pandas reads the CSV, and both find the
figures of `heft analyse` and `heft fit`. Debian: r-cran-lme4, r-cran-ordinal, python3-pandas.
Missing programs are printed, and the test exits 77 if nothing was compared.

Run: python3 tests/studies/export_against_others.py PATH_TO_HEFT [PARTICIPANTS]
"""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROTOCOLS = Path(__file__).resolve().parents[2] / "protocols"
DEBIANS = "/usr/bin/python3"  # has Debian's packages
PANDAS = r"""
import json, sys
import pandas as pd
trials, estimates, choices = (pd.read_csv(f"{sys.argv[1]}/{name}.csv")
                              for name in ("trials", "estimates", "choices"))
done = trials[trials.status == "completed"]
figures = {}
for condition, rows in done[done.task == "sorting"].groupby("condition"):
    for name, outcome in (("correct", "correct"), ("incorrect", "incorrect"), ("none", "dont_know")):
        share = 100 * (rows.outcome == outcome).groupby(rows.participant).mean()
        figures[f"sorting.{name}.mean {condition}"] = share.mean()
        figures[f"sorting.{name}.sd {condition}"] = share.std()
        figures[f"sorting.{name}.n_hits {condition}"] = int((rows.outcome == outcome).sum())
    figures[f"sorting.correct.n_trials {condition}"] = len(rows)
    figures[f"sorting.correct.n_participants {condition}"] = rows.participant.nunique()
for (condition, reference), rows in choices.groupby(["condition", "reference_g"]):
    figures[f"sensitivity.n_trials {condition} {reference:g}"] = len(rows)
    catches = rows[rows.is_catch == 1]
    if len(catches):
        figures[f"false_alarm.n_hits {condition} {reference:g}"] = int((catches.answer != "none").sum())
        figures[f"false_alarm.n_trials {condition} {reference:g}"] = len(catches)
levels = done[done.staircase.notna()].groupby(["session_id", "staircase"]).agg(
    reference_g=("reference_g", "first"), condition=("condition", "first")).reset_index()
jnds = estimates[estimates.method == "mean_of_reversals"].merge(levels, on=["session_id", "staircase"])
for (condition, reference), rows in jnds.groupby(["condition", "reference_g"]):
    figures[f"jnd.n_staircases {condition} {reference:g}"] = len(rows)
    figures[f"jnd.mean_trials {condition} {reference:g}"] = rows.n_trials.mean()
    of_people = rows.groupby("participant").jnd_g.apply(lambda jnd_g: jnd_g.mean(skipna=False))
    if of_people.notna().any():
        figures[f"jnd.paper_mean_g {condition} {reference:g}"] = of_people.mean()
for (task, condition), rows in done.groupby(["task", "condition"]):
    figures[f"response_times.median_s {task} {condition}"] = rows.response_time_s.median()
print(json.dumps(figures))
"""


def close(a, b, relative=1e-9):
    if a is None or b is None:
        return a is b
    return abs(a - b) <= relative * max(abs(a), abs(b), 1e-9)


class Comparison:
    def __init__(self, heft, folder, n_participants):
        self.heft, self.folder = heft, folder
        self.n_wrong = self.n_compared = 0
        db = folder / "lab.db"
        self.db = db
        for protocol, seed in (("examples/paired_staircases", 3), ("paper", 4), ("examples/estimation", 5)):
            self.run("simulate", PROTOCOLS / f"{protocol}.toml", "--participants", n_participants,
                     "--seed", seed, "--db", folder / f"{Path(protocol).name}.db")
        self.csv = {}
        for protocol in ("paired_staircases", "paper", "estimation"):
            self.csv[protocol] = folder / f"csv-{protocol}"
            self.run("export", folder / f"{protocol}.db", "--out", self.csv[protocol])

    def run(self, *words):
        done = subprocess.run([self.heft, *map(str, words)], capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{words}: {done.stderr}")
        return done.stdout

    def analysed(self, protocol):
        return json.loads(self.run("analyse", "--db", self.folder / f"{protocol}.db", "--json"))

    def expect(self, where, found, expected, relative=1e-9):
        self.n_compared += 1
        if not close(found, expected, relative):
            self.n_wrong += 1
            print(f"  {where}: {found}, expected {expected}")

    def printed(self, where, n_before):
        print(f"{where}: {self.n_compared - n_before} figures, {self.n_wrong} differ")

    def validated(self):
        """Validates exports with and without pseudonyms; returns whether a validator is installed."""
        validator = shutil.which("bids-validator") or os.environ.get("HEFT_BIDS_VALIDATOR")
        if not validator:
            print("bids-validator is not here (npm i bids-validator; HEFT_BIDS_VALIDATOR names it)")
            return False
        for more in ([], ["--pseudonymise"]):
            out = self.folder / f"bids{len(more)}"
            self.run("export", self.folder / "paired_staircases.db", self.folder / "paper.db", "--format",
                     "bids", "--out", out, *more)
            done = subprocess.run([validator, "--json", str(out)], capture_output=True, text=True)
            issues = json.loads(done.stdout)["issues"]
            self.n_compared += 1
            self.n_wrong += bool(issues["errors"])
            print(f"bids-validator {' '.join(more)}: {len(issues['errors'])} errors, "
                  f"{len(issues['warnings'])} warnings "
                  f"({', '.join(issue['key'] for issue in issues['warnings'])})")
            for issue in issues["errors"]:
                print("  ", issue["key"], issue["files"][0].get("evidence"))
        return True

    def sorting(self, figures, summary, relative):
        for name, found in figures.items():
            parts = name.split()
            if parts[0].startswith("sorting."):
                _, *path = parts[0].split(".")
                at = summary["sorting"][parts[1]]
                for step in path:
                    at = at[step]
                self.expect(name, found, at, relative)

    def r(self, protocol):
        if not shutil.which("Rscript"):
            print("Rscript is not here (Debian: r-base-core)")
            return False
        n_before, n_differ = self.n_compared, 0
        done = subprocess.run(["Rscript", "analysis.R"], cwd=self.csv[protocol], capture_output=True,
                              text=True)
        if done.returncode:
            raise SystemExit(done.stdout + done.stderr)
        summary = self.analysed(protocol)
        fits = {}
        if protocol != "estimation":
            fits = {fit["group"]: fit for fit in json.loads(
                self.run("fit", self.csv[protocol] / "choices.csv", "--model", "indecision", "--by",
                         "compared", "--json"))}
        with open(self.csv[protocol] / "figures.csv") as lines:
            rows = list(csv.DictReader(lines))
        for row in rows:
            found = None if row["value"] == "NA" else float(row["value"])
            condition, reference = row["condition"], row["reference_g"]
            kind, *path = row["figure"].split(".")
            if kind == "sorting":
                self.sorting({f"{row['figure']} {condition}": found}, summary, 1e-9)
            elif kind == "estimation":
                name, mass = row["figure"][len("estimation."):-len("_g")].split(".", 1)
                (one,) = [one for one in summary["estimation"] if one["condition"] == condition and
                          one["mass_g"] == float(mass)]
                self.expect(row["figure"], found, one[name], 1e-9)
            elif kind == "jnd":
                (printed,) = [one for one in summary["jnd"] if one["condition"] == condition and
                           one["reference_g"] == float(reference)]
                for name in path[:-1]:  # from_above, from_below
                    printed = printed[name]
                relative = 1e-5 if printed["summary"] == "log_normal_mean" else 1e-9
                self.expect((row["figure"], condition, reference), found, printed[path[-1]], relative)
            elif kind == "indecision":
                fit = fits[f"{condition} {float(reference):g} g"]
                if path[0] == "log_likelihood":
                    self.n_compared += 1
                    if abs(found - fit["log_likelihood"]) > 1e-5:
                        self.n_wrong += 1
                        print(row, fit["log_likelihood"])
                else:
                    parameter = fit["parameters"][path[0]]
                    scale = max(abs(parameter["se"]), abs(found))
                    self.expect((row["figure"], condition, reference), (found - parameter["value"])
                                / scale + 1, 1, 1e-3)
        self.printed(f"R {protocol}", n_before)
        return True

    def pandas(self, protocol):
        if subprocess.run([DEBIANS, "-c", "import pandas"], capture_output=True).returncode:
            print("pandas is not here (Debian: python3-pandas)")
            return False
        n_before = self.n_compared
        done = subprocess.run([DEBIANS, "-c", PANDAS, str(self.csv[protocol])], capture_output=True,
                              text=True)
        if done.returncode:
            raise SystemExit(done.stderr)
        summary = self.analysed(protocol)
        figures = json.loads(done.stdout)
        self.sorting(figures, summary, 1e-9)
        for name, found in figures.items():
            kind, *where = name.split()
            kind, field = kind.split(".")[0], kind.split(".")[-1]
            if kind in ("jnd", "sensitivity"):
                (printed,) = [one for one in summary[kind] if one["condition"] == where[0] and
                           one["reference_g"] == float(where[1])]
                printed = {**printed, "mean_trials": printed["trials"]["mean"]} if kind == "jnd" else printed
                self.expect(name, found, printed[field])
            elif kind == "false_alarm":
                (printed,) = [one for one in summary["comparison"]["by_reference"]
                           if one["reference_g"] == float(where[1])]
                self.expect(name, found, printed["false_alarm"][field])
            elif kind == "response_times":
                (printed,) = [one for one in summary["response_times"]
                           if [one["task"], one["condition"]] == where]
                self.expect(name, found, printed[field])
        self.printed(f"pandas {protocol}", n_before)
        return True


def main():
    heft = os.path.abspath(sys.argv[1])
    n_participants = int(sys.argv[2]) if len(sys.argv) > 2 else 13
    with tempfile.TemporaryDirectory() as folder:
        comparison = Comparison(heft, Path(folder), n_participants)
        done = [comparison.validated()]
        for protocol in ("paired_staircases", "paper"):
            done += [comparison.r(protocol), comparison.pandas(protocol)]
        done.append(comparison.r("estimation"))
    print(f"{comparison.n_compared} comparisons, {comparison.n_wrong} differ")
    raise SystemExit(77 if not any(done) else min(comparison.n_wrong, 1))


if __name__ == "__main__":
    main()

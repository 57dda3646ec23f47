"""Does anything but the technique reveal mass? A study of simulated sessions of paired_staircases.toml: for
each cue that a participant could have before the answer (side, order, time until the cubes are
there, cubes put back, jumps of clone and cubes from one displayed frame to the next), how well it
alone tells the mass, against chance.

A cue of a cube tells which of the cubes of a trial is heavier: the percentage of pairs in which the
heavier has more of it, ties counting half. A cue of a trial tells whether its difference is large
(above the median of its reference in this session) or none at all (catch trials): the area under
the ROC curve. A figure a session, then their mean against 50 % by the normal approximation, at 1 %
divided by the number of cues (Bonferroni); the interval printed is that of all cues together.

Run: python3 tests/studies/cues_study.py PATH_TO_HEFT [SESSIONS [LOG...]] [--csv FILE]
"""
import argparse
import csv
import math
import os
import sqlite3
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import NormalDist

PROTOCOL = Path(__file__).resolve().parents[2] / "protocols" / "examples" / "paired_staircases.toml"
ALPHA = 0.01
JUMP_M = 0.05  # from one frame to the next; a hand at 0.5 m/s gets 33 mm far in a fifteenth of a second


def area(values, targets):
    """Under the ROC curve; none without both classes."""
    yes = [v for v, t in zip(values, targets) if t]
    no = [v for v, t in zip(values, targets) if not t]
    if not yes or not no:
        return None
    order = sorted(no)
    from bisect import bisect_left, bisect_right
    return sum((bisect_left(order, v) + bisect_right(order, v)) / 2 for v in yes) / len(yes) / len(no)


def pairs_told(trials, cue):
    """Of pairs of cubes of one trial whose masses differ."""
    told = n = 0
    for trial in trials:
        cubes = trial["cubes"]
        for i, one in enumerate(cubes):
            for other in cubes[:i]:
                if one["mass_g"] == other["mass_g"]:
                    continue
                heavy, light = (one, other) if one["mass_g"] > other["mass_g"] else (other, one)
                n += 1
                told += 0.5 * ((cue(heavy) > cue(light)) + (cue(heavy) >= cue(light)))
    return told / n if n else None


def heavier_side(trial):
    cubes = trial["cubes"]
    return None if len(cubes) != 2 or cubes[0]["mass_g"] == cubes[1]["mass_g"] else \
        cubes[1]["mass_g"] > cubes[0]["mass_g"]


def foretold(trials):
    """Guessing that the heavier cube is not where it was the trial before."""
    sides = [side for side in map(heavier_side, trials) if side is not None]
    told = [after != before for before, after in zip(sides, sides[1:])]
    return sum(told) / len(told) if told else None


def is_large(trials):
    """By trial: the difference is above the median of its reference; none for catch trials."""
    by_reference = {}
    for trial in trials:
        if not trial["is_catch"]:
            by_reference.setdefault(trial["reference_g"], []).append(trial["level_g"])
    medians = {g: sorted(levels)[len(levels) // 2] for g, levels in by_reference.items()}
    return [None if t["is_catch"] else t["level_g"] > medians[t["reference_g"]] for t in trials]


def of_trials(trials, value, target):
    """By reference, weighted by trials."""
    sum_of, n = 0, 0
    for reference in {trial["reference_g"] for trial in trials}:
        chosen = [(value(trial), wanted) for trial, wanted in zip(trials, target)
                  if trial["reference_g"] == reference and wanted is not None
                  and value(trial) is not None]
        found = area([v for v, _ in chosen], [w for _, w in chosen])
        if found is not None:
            sum_of, n = sum_of + found * len(chosen), n + len(chosen)
    return sum_of / n if n else None


def cues_of(trials):
    """-> {cue: fraction of correct predictions, 0.5 by chance}"""
    sorting = [t for t in trials if t["task"] == "sorting"]
    c1 = [t for t in sorting if t["condition"] == "C1"]
    compared = [t for t in trials if t["task"] == "comparison"]
    catches = [t["is_catch"] == 1 for t in compared]
    large = is_large(compared)
    def delay(trial):
        return trial["shown_s"] - trial["started_s"]
    def resets(trial):
        return sum(cube["n_resets"] for cube in trial["cubes"])
    def jumps(trial):
        return trial["n_jumps"]
    def clone_jumps(trial):
        return trial["clone_jumps"]
    figures = {
        "side, sorting": pairs_told(sorting, lambda cube: cube["slot"]),
        "side, comparison": pairs_told(compared, lambda cube: cube["slot"]),
        "order: the other side than before": foretold(compared),
        "put back, sorting": pairs_told(sorting, lambda cube: cube["n_resets"]),
        "put back, sorting in C1": pairs_told(c1, lambda cube: cube["n_resets"]),
        "put back, comparison": pairs_told(compared, lambda cube: cube["n_resets"]),
        "time until the cubes, large difference": of_trials(compared, delay, large),
        "time until the cubes, catch trial": of_trials(compared, delay, catches),
        "time since the trial before, large difference":
            of_trials(compared, lambda t: t["since_s"], large),
        "time since the trial before, catch trial":
            of_trials(compared, lambda t: t["since_s"], catches),
    }
    if any(trial["n_frames"] for trial in trials):
        figures["tracking jumps, large difference"] = of_trials(compared, jumps, large)
        figures["tracking jumps, catch trial"] = of_trials(compared, jumps, catches)
        figures["clone jumps, large difference"] = of_trials(compared, clone_jumps, large)
        figures["clone jumps, catch trial"] = of_trials(compared, clone_jumps, catches)
        figures["cube jumps, sorting"] = pairs_told(sorting, lambda cube: cube["n_jumps"])
        figures["cube jumps, comparison"] = pairs_told(compared, lambda cube: cube["n_jumps"])
        figures["cube jumps as it is put back, sorting in C1"] = pairs_told(c1, jumps_back)
    # What follows from pushing, as the technique has it: printed beside, not judged. A cube that is
    # put back jumps as far as it was seen to be pushed.
    beside = {"any cube put back, large difference": of_trials(compared, resets, large)}
    if any(trial["n_frames"] for trial in trials):
        c2 = [t for t in sorting if t["condition"] == "C2"]
        beside["cube jumps as it is put back, sorting in C2"] = pairs_told(c2, jumps_back)
        beside["cube jumps as it is put back, comparison"] = pairs_told(compared, jumps_back)
    return figures, beside


def jumps_back(cube):
    return cube["n_jumps_back"]


def distance(one, other):
    return 0 if None in (*one, *other) else math.dist(one, other)


def count_jumps(connection, session, by_id):
    """Of the clone without the effector, and of each cube: to where its trial began, or elsewhere."""
    cubes = [f"cube{slot}" for slot in range(1, 4)]
    bodies = ["effector", "clone", *cubes]
    columns = ", ".join(f"{body}_{axis}_m" for body in bodies for axis in "xyz")
    before_trial, before, start = None, {}, {}
    for trial, *values in connection.execute(
            f"select trial_id, {columns} from frame where session_id = ? order by frame_id", (session,)):
        places = {body: values[3 * i:3 * i + 3] for i, body in enumerate(bodies)}
        if trial != before_trial:
            start = {}
        elif trial in by_id:
            jumps = {body: distance(before[body], places[body]) > JUMP_M for body in bodies}
            by_id[trial]["clone_jumps"] += jumps["clone"] and not jumps["effector"]
            for cube in by_id[trial]["cubes"]:
                body = cubes[cube["slot"] - 1]
                is_back = distance(places[body], start.get(body, places[body])) < 0.001
                cube["n_jumps_back" if is_back else "n_jumps"] += jumps[body]
        for body in bodies:
            if None not in places[body]:
                start.setdefault(body, places[body])
        before_trial, before = trial, places


def sessions_of(log):
    connection = sqlite3.connect(f"file:{log}?mode=ro", uri=True)
    connection.row_factory = sqlite3.Row
    for (session,) in connection.execute("select session_id from session where state = 'finished'"):
        trials = [dict(row, cubes=[], n_frames=0, n_jumps=0, clone_jumps=0) for row in connection.execute(
            "select trial_id, task, condition, reference_g, level_g, is_catch, started_s, shown_s, "
            "ended_s from trial where session_id = ? and status = 'completed' order by trial_id",
            (session,))]
        by_id = {trial["trial_id"]: trial for trial in trials}
        for cube in connection.execute(
                "select c.* from cube c join trial t using (trial_id) where t.session_id = ? order by "
                "trial_id, slot", (session,)):
            if cube["trial_id"] in by_id:
                by_id[cube["trial_id"]]["cubes"].append(dict(cube, n_jumps=0, n_jumps_back=0))
        for trial, n, jumps in connection.execute(
                "select trial_id, count(*), sum(jump) from frame where session_id = ? group by "
                "trial_id", (session,)):
            if trial in by_id:
                by_id[trial].update(n_frames=n, n_jumps=jumps)
        count_jumps(connection, session, by_id)
        for before, trial in zip([None] + trials, trials):
            same = before and before["task"] == trial["task"]  # a break tells that blocks change
            trial["since_s"] = trial["shown_s"] - before["ended_s"] if same else None
        yield trials
    connection.close()


def judged(figures):
    """-> mean, standard error, two-sided p by the normal approximation to t"""
    mean = sum(figures) / len(figures)
    if len(figures) < 2:
        return mean, 0, 1
    se = math.sqrt(sum((f - mean) ** 2 for f in figures) / (len(figures) - 1) / len(figures))
    p = 1 if abs(mean - 0.5) < 1e-12 else 0 if se == 0 else math.erfc(abs(mean - 0.5) / se / math.sqrt(2))
    return mean, se, p


def study(log, table):
    """-> how many cues tell the mass. table: takes a row a cue"""
    found, beside, n = {}, {}, 0
    for trials in sessions_of(log):
        n += 1
        for all_figures, figures in zip((found, beside), cues_of(trials)):
            for cue, figure in figures.items():
                if figure is not None:
                    all_figures.setdefault(cue, []).append(figure)
    n_told = 0
    reach = NormalDist().inv_cdf(1 - ALPHA / len(found) / 2)
    print(f"{n} sessions; chance is 50 %, and a cue tells where p < {ALPHA} / {len(found)}")
    for cue, figures in found.items():
        mean, se, p = judged(figures)
        tells = p < ALPHA / len(found)  # one that is turned round tells as much
        n_told += tells
        table.append([cue, len(figures), 100 * mean, 100 * (mean - reach * se),
                      100 * (mean + reach * se), p, "judged", "yes" if tells else "no"])
        print(f"  {cue:48} {100 * mean:6.2f} % [{100 * (mean - reach * se):.2f}, "
              f"{100 * (mean + reach * se):.2f}], p {p:.3g}{'  TELLS' if tells else ''}")
    for cue, figures in beside.items():
        mean, se, p = judged(figures)
        table.append([cue, len(figures), 100 * mean, 100 * (mean - reach * se),
                      100 * (mean + reach * se), p, "beside", ""])
        print(f"  beside: {cue:40} {100 * mean:6.2f} % (SE {100 * se:.2f}), p {p:.3g}")
    return n_told


def write(table, file, n_sessions):
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=PROTOCOL.parent,
                            capture_output=True, text=True).stdout.strip()
    command = f"python3 tests/studies/cues_study.py build/heft {n_sessions} --csv {file}"
    with open(file, "w", newline="") as out:
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow(["cue", "n_sessions", "percent", "low_percent", "high_percent", "p", "role",
                       "tells", "commit", "command"])
        rows.writerows([*row, commit, command] for row in table)


def simulated(heft, folder, n_sessions):
    """-> logs: without frames, and of fewer sessions with frames, ten megabytes each"""
    for name, n, seed, more in (("cues", n_sessions, 77, []),
                                ("frames", max(n_sessions // 25, 2), 78, ["--frames"])):
        log = Path(folder) / f"{name}.db"
        subprocess.run([heft, "simulate", PROTOCOL, "--participants", str(n), "--seed", str(seed),
                        *more, "--db", log], check=True, stderr=subprocess.DEVNULL)
        yield log


def main():
    options = argparse.ArgumentParser()
    options.add_argument("heft")
    options.add_argument("sessions", nargs="?", type=int, default=500)
    options.add_argument("logs", nargs="*")
    options.add_argument("--csv")
    asked = options.parse_args()
    table = []
    with tempfile.TemporaryDirectory() as folder:
        logs = asked.logs or simulated(os.path.abspath(asked.heft), folder, asked.sessions)
        n_told = sum(study(log, table) for log in logs)
    if asked.csv:
        write(table, asked.csv, asked.sessions)
    raise SystemExit(min(n_told, 1))


if __name__ == "__main__":
    main()

"""What the cheaper levels of simulation cost in accuracy: the same simulated people by `heft simulate
--level surrogate`, `hand` and `camera`. Writes ladder.csv and ladder.svg beside this file.

Run: python3 results/responders/measure.py PATH_TO_HEFT [PEOPLE_BEFORE_THE_CAMERA]
"""
import csv
import math
import resource
import sqlite3
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SEED = 1
# Protocol, its levels from the most exact one on, and how many people each has.
LADDERS = {"paper": {"hand": 100, "surrogate": 100}, "quick": {"camera": 0, "hand": 300, "surrogate": 300}}
QUERIES = {
    "JND, g": "select participant, avg(jnd_g) from v_jnd where reference_g = 200 and jnd_g is not null "
              "group by participant",
    "correct in C2, %": "select s.participant, 100.0 * avg(t.outcome = 'correct') from trial t join session s "
                        "using (session_id) where t.task = 'sorting' and t.condition = 'C2' and "
                        "t.status = 'completed' group by 1",
    "answers \"difference\", %": "select s.participant, 100.0 * avg(t.outcome = 'difference') from trial t join "
                                 "session s using (session_id) where t.task = 'comparison' and "
                                 "t.status = 'completed' group by 1",
    "largest push, mm": "select s.participant, 1000 * avg(c.max_push_displacement_m) from cube c join trial t "
                        "using (trial_id) join session s using (session_id) where t.status = 'completed' "
                        "and c.n_pushes > 0 group by 1",
    "pushes in a trial": "select s.participant, 1.0 * sum(c.n_pushes) / count(distinct t.trial_id) from "
                         "cube c join trial t using (trial_id) join session s using "
                         "(session_id) where t.status = 'completed' group by 1",
}
COLUMNS = ["protocol", "figure", "level", "reference_level", "people", "mean", "reference_mean", "bias",
           "bias_se", "sd", "reference_sd", "cpu_s_per_person", "reference_cpu_s_per_person"]


def simulated(heft, protocol, level, people, folder):
    """Figures of each person, and CPU seconds for one."""
    db = folder / f"{protocol}-{level}.db"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([heft, "simulate", ROOT / f"protocols/{protocol}.toml", "--level", level,
                    "--participants", str(people), "--seed", str(SEED), "--db", db], check=True,
                   capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    with sqlite3.connect(db) as log:
        figures = {name: dict(log.execute(query)) for name, query in QUERIES.items()}
    return figures, (after.ru_utime - before.ru_utime) / people


def compared(protocol, of, by):
    """Rows of one level against a more exact one, on the people that both have."""
    (level, figures, cpu_s), (reference, reference_figures, reference_cpu_s) = of, by
    for name in QUERIES:
        shared = sorted(set(figures[name]) & set(reference_figures[name]))
        here = [figures[name][one] for one in shared]
        there = [reference_figures[name][one] for one in shared]
        differences = [a - b for a, b in zip(here, there)]
        yield dict(zip(COLUMNS, [
            protocol, name, level, reference, len(shared), statistics.mean(here), statistics.mean(there),
            statistics.mean(differences), statistics.stdev(differences) / math.sqrt(len(shared)),
            statistics.stdev(here), statistics.stdev(there), cpu_s, reference_cpu_s]))


def draw(rows, command):
    """Bias in % of the more exact level's mean, with 95 % intervals, a panel for each comparison."""
    panels = sorted({(row["protocol"], row["level"], row["reference_level"]) for row in rows})
    script = ["set terminal svg size 960,400 font 'DejaVu Sans,12' background '#ffffff'",
              f"set output '{HERE / 'ladder.svg'}'",
              "set multiplot title 'Bias of the means of the same simulated people by a cheaper level, with 95 % "
              "intervals' font ',14'",
              "set xrange [-12:12]", f"set yrange [-0.6:{len(QUERIES) - 0.4}]", "set tmargin at screen 0.76",
              "set bmargin at screen 0.24", "set xlabel 'bias, % of the mean'",
              "set grid x linecolor '#dddddd'",
              "set arrow from 0, graph 0 to 0, graph 1 nohead linecolor '#888888'",
              f"set label 1 'Made by: {command}' at screen 0.02, screen 0.04 font ',9' textcolor '#777777'"]
    for k, (protocol, level, reference) in enumerate(panels):
        of = [row for row in rows if (row["protocol"], row["level"]) == (protocol, level)
              and row["reference_level"] == reference]
        tics = ", ".join(f"'{row['figure'].split(',')[0] if k == 0 else ''}' {i}" for i, row in enumerate(of))
        script += [f"set lmargin at screen {0.2 + 0.27 * k}", f"set rmargin at screen {0.43 + 0.27 * k}",
                   f"set ytics ({tics})",
                   f'set title "{protocol}.toml\\n{level} against {reference}\\n{of[0]["people"]} people, CPU '
                   f'{of[0]["cpu_s_per_person"]:.2g} against {of[0]["reference_cpu_s_per_person"]:.2g} s" font ",11"',
                   f"$p{k} << END",
                   *(f"{100 * row['bias'] / row['reference_mean']} {i} "
                     f"{196 * row['bias_se'] / row['reference_mean']}" for i, row in enumerate(of)), "END",
                   f"plot $p{k} using 1:2:3 with xerrorbars pointtype 7 linecolor '#0072b2' notitle",
                   "unset label 1"]
    script += ["unset multiplot"]
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


def main():
    heft = sys.argv[1]
    n_camera = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    command = " ".join(["python3 results/responders/measure.py build/heft", *sys.argv[2:]])
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=HERE, capture_output=True,
                            text=True, check=True).stdout.strip()
    rows = []
    with tempfile.TemporaryDirectory() as name:
        for protocol, levels in LADDERS.items():
            done = [(level, *simulated(heft, protocol, level, people or n_camera, Path(name)))
                    for level, people in levels.items()]
            for better, worse in zip(done, done[1:]):
                rows += compared(protocol, worse, better)
    with open(HERE / "ladder.csv", "w", newline="") as out:
        table = csv.DictWriter(out, [*COLUMNS, "commit", "command"], lineterminator="\n")
        table.writeheader()
        table.writerows({**row, "commit": commit, "command": command} for row in rows)
    draw(rows, command)
    for row in rows:
        print(f"{row['protocol']:6} {row['figure']:26} {row['level']:9} {row['mean']:8.2f}, "
              f"{row['reference_level']:6} {row['reference_mean']:8.2f}: bias {row['bias']:+.2f} +- "
              f"{row['bias_se']:.2f}, SD {row['sd']:.2f} and {row['reference_sd']:.2f}, "
              f"{row['people']} people")


if __name__ == "__main__":
    main()

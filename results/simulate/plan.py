"""What many simulated participants need: CPU time and disk of one, measured, and of a million, computed.
CPU times are those that the system counts, so that other programs on the machine matter little.

Run: python3 results/simulate/plan.py PATH_TO_HEFT   (writes plan.csv beside this file)
"""
import csv
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
MEASURED, SHARDS, PLANNED, TASKS = 40, 4, 10**6, 1000
COLUMNS = ["protocol", "level", "responder", "simulated_per_cpu_min", "merged_per_cpu_min", "kb_each",
           "cpu_h_for_1e6", "h_of_a_task", "merge_h", "gb_for_1e6", "commit", "command"]


def cpu_s(*words):
    """CPU time of a command, including its threads."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([*map(str, words)], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measured(heft, protocol, level, responder, folder):
    name = f"{protocol}-{level}-{responder}"
    shards = [folder / f"{name}-{number}.db" for number in range(1, SHARDS + 1)]
    merged = folder / f"{name}.db"
    command = ["simulate", f"protocols/{protocol}.toml", "--level", level, "--responder", responder,
               "--participants", MEASURED, "--seed", 1]
    simulate_s = sum(cpu_s(heft, *command, "--jobs", 1, "--shard", f"{number}/{SHARDS}", "--db", db)
                     for number, db in enumerate(shards, 1))
    merge_s = cpu_s(heft, "merge", merged, *shards)
    simulated, joined = 60 * MEASURED / simulate_s, 60 * MEASURED / merge_s
    kb = os.path.getsize(merged) / 1000 / MEASURED
    return [protocol, level, responder, f"{simulated:.0f}", f"{joined:.0f}", f"{kb:.0f}",
            f"{PLANNED / simulated / 60:.0f}", f"{PLANNED / simulated / 60 / TASKS:.2f}",
            f"{PLANNED / joined / 60:.1f}", f"{kb * PLANNED / 1e6:.0f}",
            subprocess.run(["git", "rev-parse", "--short", "HEAD"], check=True, capture_output=True,
                           text=True).stdout.strip(),
            "heft " + " ".join(map(str, command))]


def main():
    heft = os.path.abspath(sys.argv[1])
    os.chdir(ROOT)
    with tempfile.TemporaryDirectory() as folder, open(HERE / "plan.csv", "w", newline="") as out:
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow(COLUMNS)
        for protocol in ("quick", "jnd", "paper"):
            for level, responder in (("hand", "simulated"), ("surrogate", "simulated"), ("hand", "coin")):
                rows.writerow(measured(heft, protocol, level, responder, Path(folder)))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Two interleaved staircases in an experiment of your own, with Heft's Python module.

    python3 staircase_loop.py
"""
import heft

rule = {"kind": "up_down", "start": 175, "step": 50, "halve_every": 2, "floor": 0}  # differences in g
procedure = heft.Procedure({"name": "15g", **rule}, {"name": "65g", **rule, "start": 200}, seed=1)

for trial in procedure:
    # Here you present trial.level and ask. This observer perceives more than 62 g.
    perceived = trial.level > 62
    trial.answer(perceived)  # or trial.void(), where a trial was disturbed
    print(f"{trial.number:3}  {trial.staircase}  {trial.level:6.1f} g  {perceived}")

for name, staircase in procedure.staircases.items():
    print(f"{name}: {staircase.estimates[0].value:.1f} g after {staircase.n_trials} trials")

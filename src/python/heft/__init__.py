"""Heft's procedures, fits, logs and simulations.

A staircase, with an observer who perceives differences of more than 62 g:

    import heft

    staircase = heft.Procedure(
        {"kind": "up_down", "start": 175, "step": 50, "halve_every": 2, "floor": 0}
    )
    for trial in staircase:
        trial.answer(trial.level > 62)
    print(staircase.estimates[0].value)

Procedure    adaptive procedures and constant stimuli, trial by trial
fit          psychometric functions and the indecision model
read_log     a log's tables and views as pandas data frames
simulate     sessions of a protocol with simulated participants

Mistakes in files, data and options are a ValueError with the message of the program heft.
"""
from ._heft import version as __version__
from .fits import Fit, FittedParameter, GoodnessOfFit, PersonThreshold, fit
from .log import read_log
from .procedure import Estimate, ParameterPosterior, Procedure, Reversal, Staircase, Trial
from .program import simulate

__all__ = ["Estimate", "Fit", "FittedParameter", "GoodnessOfFit", "ParameterPosterior",
           "PersonThreshold", "Procedure", "Reversal", "Staircase", "Trial", "__version__", "fit",
           "read_log", "simulate"]

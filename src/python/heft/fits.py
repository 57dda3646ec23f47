"""Fits of psychometric functions and of the indecision model, as `heft fit` makes them."""
from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, overload

from . import _heft

if TYPE_CHECKING:
    import pandas


class FittedParameter(NamedTuple):
    """A parameter; None: not identifiable, or of an interval's end that it is infinite."""

    value: float | None
    se: float | None  #: from the observed information; None also if fixed or at a bound
    low: float | None  #: ends of the 95 % profile interval
    high: float | None
    fixed: bool


class PersonThreshold(NamedTuple):
    """The 75 %-correct threshold of one person, in g."""

    value: float | None
    low: float | None  #: ends of the 95 % interval
    high: float | None
    identifiable: bool
    why: str | None  #: it is not identifiable


class GoodnessOfFit(NamedTuple):
    """Deviance from the saturated model; None: it can't be judged."""

    deviance: float | None
    degrees_of_freedom: int | None
    p: float | None  #: share of simulated and refitted data sets with a deviance as large
    n_simulated: int
    why: str | None  #: it can't be judged


class Fit(NamedTuple):
    """A maximum-likelihood fit.

    parameters, psychometric: threshold and slope (unit of x), guess, lapse
    parameters, indecision: sensitivity (1/g), indecision (criterion half-width, SD of the internal
        noise), bias (the same), lapse, threshold_75_g (g); with person also the SDs between people
    """

    parameters: dict[str, FittedParameter]
    log_likelihood: float | None  #: without binomial coefficients
    n_trials: int
    identifiable: bool  #: there is a threshold
    why: str | None  #: there is none
    people: dict[str, PersonThreshold]  #: with person, each one's threshold
    goodness_of_fit: GoodnessOfFit


@overload
def fit(data: pandas.DataFrame | Mapping[str, Sequence[Any]] | str | os.PathLike[str],
        model: str, *, function: str | None = None, scale: str | None = None,
        guess: float | str | None = None, lapse: float | str | None = None, by: None = None,
        person: str | None = None) -> Fit: ...


@overload
def fit(data: pandas.DataFrame | Mapping[str, Sequence[Any]] | str | os.PathLike[str],
        model: str, *, function: str | None = None, scale: str | None = None,
        guess: float | str | None = None, lapse: float | str | None = None, by: str,
        person: str | None = None) -> dict[str, Fit]: ...


def fit(data: pandas.DataFrame | Mapping[str, Sequence[Any]] | str | os.PathLike[str],
        model: str, *, function: str | None = None, scale: str | None = None,
        guess: float | str | None = None, lapse: float | str | None = None, by: str | None = None,
        person: str | None = None) -> Fit | dict[str, Fit]:
    """The fit of answers; with `by` one for each value of that column.

    data: a data frame, columns by name, or the path of a CSV file. Psychometric: x, n_positive, n
        or, a row a trial, x, response (0 or 1). Indecision: level_g, answer ("comparison",
        "reference" or "none").
    model: "psychometric" or "indecision"
    function: "cumulative_normal" (default), "logistic", "weibull" or "gumbel"
    scale: what x is, for Weibull's formula: "linear" (default), "log10" or "db"
    guess, lapse: rates, fixed or "free" up to 0.5. Default: 0
    person: the column of who answered; one fit of all people, who differ (mixed model)

    `heft fit --help` has the formulas. Raises ValueError with the rows and options that are wrong,
    OSError if a file cannot be read. Warns where answers of several people are pooled.
    """
    text, file = _csv_of(data)
    found, warning = _heft.fit(text, file, model, function, scale, _word(guess), _word(lapse), by,
                               person)
    if warning:
        warnings.warn(warning, stacklevel=2)
    fits = {one["group"]: _fit_of(one) for one in json.loads(found)}
    return fits if by is not None else fits[None]


def _csv_of(data: Any) -> tuple[bytes, str]:
    """Contents and name of a CSV file."""
    if isinstance(data, (str, os.PathLike)):
        return Path(data).read_bytes(), os.fspath(data)
    import pandas

    frame = pandas.DataFrame(data)
    flags = frame.select_dtypes(bool).columns
    return frame.astype({name: int for name in flags}).to_csv(index=False).encode(), "data"


def _word(rate: float | str | None) -> str | None:
    return None if rate is None else str(rate)


def _fit_of(found: dict[str, Any]) -> Fit:
    return Fit(
        parameters={name: FittedParameter(**one) for name, one in found["parameters"].items()},
        log_likelihood=found["log_likelihood"], n_trials=found["n_trials"],
        identifiable=found["identifiable"], why=found["why"],
        people={name: PersonThreshold(**one) for name, one in found.get("people", {}).items()},
        goodness_of_fit=GoodnessOfFit(**found["goodness_of_fit"]))

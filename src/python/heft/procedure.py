"""Procedures, trial by trial. Levels and steps are in any unit, the same for all of a staircase."""
from __future__ import annotations

import json
import numbers
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from . import _heft


class Reversal(NamedTuple):
    """A reversal of a staircase."""

    number: int  #: from 1
    trial: int  #: number of the trial
    level: float  #: presented in that trial
    step_before: float  #: step in its direction before the reversal
    step_after: float


class Estimate(NamedTuple):
    """The estimate of one method, in the unit of levels; None: the method does not give it."""

    method: str
    value: float | None
    low: float | None  #: ends of the 95 % interval
    high: float | None
    sd: float | None  #: of the posterior
    censored: str  #: "none", "above" (only low is known), "below" or "indeterminate"
    n_trials: int
    n_reversals: int
    n_floor: int  #: moves that a bound shortened
    n_ceiling: int


class ParameterPosterior(NamedTuple):
    """The posterior of one parameter of a Bayesian kind."""

    mean: float
    sd: float
    mode: float  #: of all parameters together
    low: float  #: ends of the central 95 % interval
    high: float


class Trial:
    """An open trial. It is closed by answer() or void()."""

    def __init__(self, procedure: Procedure, number: int, staircase: str, level: float) -> None:
        self._procedure = procedure
        self.number = number  #: from 1
        self.staircase = staircase  #: name
        self.level = level  #: to be presented

    def __repr__(self) -> str:
        return f"Trial(number={self.number}, staircase={self.staircase!r}, level={self.level!r})"

    def answer(self, response: bool | str, level: float | None = None) -> Reversal | None:
        """Records the response.

        response: whether it is positive (perceived, correct), or the stimulus that was more:
            "comparison", "reference" or "none"
        level: the level that was presented, if it differs from the trial's
        Returns the reversal, if there was one.
        Raises ValueError if the response or the level is none, or the trial is not open.
        """
        return self._procedure._close(self, response, level)

    def void(self) -> None:
        """Leaves the staircase unchanged; the next trial is drawn again."""
        self._procedure._void(self)


class Staircase:
    """What is known about one procedure of a Procedure, at any time."""

    def __init__(self, run: _heft.Run, name: str) -> None:
        self._run = run
        self.name = name
        self.reversals: list[Reversal] = []

    @property
    def n_trials(self) -> int:
        """Trials with an answer."""
        return self._run.n_trials(self.name)

    @property
    def stopped_by(self) -> str | None:
        """ "reversals", "trials" or "precision"; None: it is not finished."""
        return self._run.stopped_by(self.name)

    @property
    def estimates(self) -> list[Estimate]:
        """One for each method; reports use the first."""
        return [Estimate(**values) for values in self._run.estimates(self.name)]

    @property
    def posterior(self) -> dict[str, ParameterPosterior]:
        """By parameter; empty for kinds that are not Bayesian."""
        return {name: ParameterPosterior(**values)
                for name, values in self._run.posterior(self.name).items()}


class Procedure:
    """One or several interleaved procedures: the trials of `heft procedure` for the same answers.

        for trial in heft.Procedure({"kind": "up_down", "start": 175, "step": 50}):
            trial.answer(was_perceived(trial.level))

    staircases: the keys of a [[staircase]] each (`heft procedure --help-all` lists them); or one
        whole procedure file, as tomllib reads it. A single one needs no name.
    keys: those of the whole file: seed, interleave, max_lag
    Raises ValueError with all mistakes. Line N of a message is the N-th key.
    """

    def __init__(self, *staircases: Mapping[str, Any], **keys: Any) -> None:
        self._start(_file_of(staircases, keys).encode(), "procedure")

    @classmethod
    def from_toml(cls, text: str, file: str = "procedure") -> Procedure:
        """From the text of a procedure file. file: its name, for messages."""
        procedure = cls.__new__(cls)
        procedure._start(text.encode(), file)
        return procedure

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Procedure:
        """From a procedure file. Raises OSError if it cannot be read."""
        procedure = cls.__new__(cls)
        procedure._start(Path(path).read_bytes(), os.fspath(path))
        return procedure

    def _start(self, text: bytes, file: str) -> None:
        self._run = _heft.Run(text, file)
        #: by name, in the order of the file
        self.staircases: dict[str, Staircase] = {
            name: Staircase(self._run, name) for name in self._run.names()}
        self._open()

    def _open(self) -> None:
        run = self._run
        #: the open trial; None: all staircases are finished
        self.trial: Trial | None = None if run.finished else Trial(self, run.trial, run.staircase,
                                                                   run.level)

    def __iter__(self) -> Iterator[Trial]:
        """The trials until all staircases are finished. Each must be answered or voided."""
        while (trial := self.trial) is not None:
            yield trial
            if self.trial is trial:
                raise RuntimeError(f"trial {trial.number} is still open: call its answer() or "
                                   "void() before the next one")

    @property
    def finished(self) -> bool:
        """Whether all staircases are."""
        return self.trial is None

    @property
    def level(self) -> float | None:
        """Of the open trial; None: all staircases are finished."""
        return self.trial.level if self.trial else None

    def answer(self, response: bool | str, level: float | None = None) -> Reversal | None:
        """Records the response to the open trial, as Trial.answer()."""
        return self._close(self.trial, response, level)

    def void(self) -> None:
        """As Trial.void(), of the open trial."""
        self._void(self.trial)

    @property
    def reversals(self) -> list[Reversal]:
        """Of the only staircase; of several, see staircases."""
        return self._only().reversals

    @property
    def estimates(self) -> list[Estimate]:
        """Of the only staircase, the first is that of reports; of several, see staircases."""
        return self._only().estimates

    @property
    def posterior(self) -> dict[str, ParameterPosterior]:
        """Of the only staircase, by parameter; of several, see staircases."""
        return self._only().posterior

    def _only(self) -> Staircase:
        if len(self.staircases) > 1:
            raise ValueError(f"there are {len(self.staircases)} staircases, expected the name of "
                             f"one: staircases[{next(iter(self.staircases))!r}]")
        return next(iter(self.staircases.values()))

    def _require_open(self, trial: Trial | None) -> None:
        if trial is not self.trial:
            raise ValueError(f"{trial} is not open any more")

    def _close(self, trial: Trial | None, response: bool | str,
               level: float | None) -> Reversal | None:
        self._require_open(trial)
        if not isinstance(response, str):
            if response not in (0, 1):
                raise ValueError(f"the response is {response!r}, expected True, False, "
                                 '"comparison", "reference" or "none"')
            response = bool(response)  # also NumPy's
        values = self._run.respond(response, level)
        reversal = None
        if trial and values:
            reversal = Reversal(trial=trial.number, **values)
            self.staircases[trial.staircase].reversals.append(reversal)
        self._open()
        return reversal

    def _void(self, trial: Trial | None) -> None:
        self._require_open(trial)
        self._run.void_trial()
        self._open()


def _file_of(staircases: tuple[Mapping[str, Any], ...], keys: Mapping[str, Any]) -> str:
    """A procedure file, with a key a line."""
    if len(staircases) == 1 and "staircase" in staircases[0]:
        keys = {**staircases[0], **keys}
        staircases = tuple(keys.pop("staircase"))
    elif len(staircases) == 1:
        staircases = ({"name": "staircase", **staircases[0]},)
    lines = _lines_of(keys)
    for staircase in staircases:
        lines += ["[[staircase]]", *_lines_of(staircase)]
    return "\n".join(lines)


def _lines_of(table: Mapping[str, Any]) -> list[str]:
    return [f"{json.dumps(key)} = {_toml(value)}" for key, value in table.items()
            if value is not None]


def _toml(value: Any) -> str:
    if hasattr(value, "tolist"):  # NumPy's and pandas'
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(_lines_of(value)) + "}"
    if isinstance(value, Iterable):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise ValueError(f"{value!r} is no value of a procedure, expected a number, a text, a list or "
                     "a dict")

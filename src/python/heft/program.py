"""What the program heft does, started from Python."""
from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

INVALID = (2, 3)  # exit codes: usage, invalid file


def simulate(protocol: str | os.PathLike[str], n: int, seed: int, db: str | os.PathLike[str],
             *options: str) -> Path:
    """Stores n simulated sessions of a protocol in a log: the rows of `heft simulate`.

    protocol: a protocol file
    n: number of participants
    seed: of all draws; the same seed gives the same data
    db: the log; an existing one gets more sessions
    options: further words of the command line, such as "--responder", "coin"

    Returns the log's path, for read_log(). Simulated participants are a model, no evidence about
    people. Raises ValueError for a mistake in the protocol or an option, RuntimeError if the
    simulation failed, FileNotFoundError without the protocol or the program.
    """
    os.stat(protocol)
    done = subprocess.run(
        [_program(), "simulate", os.fspath(protocol), "--participants", str(n), "--seed", str(seed),
         "--db", os.fspath(db), *options], stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise (ValueError if done.returncode in INVALID else RuntimeError)(done.stderr.strip())
    return Path(db)


def _program() -> str:
    """Of the same build folder or installation, else the PATH's."""
    here = Path(__file__).absolute().parents
    for program in (here[2] / "heft", here[4] / "bin" / "heft"):
        if program.is_file():
            return str(program)
    if found := shutil.which("heft"):
        return found
    raise FileNotFoundError("the program heft is not on the PATH; install the package heft")

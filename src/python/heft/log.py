"""Logs as pandas data frames."""
from __future__ import annotations

import os
import shutil
import sqlite3
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from . import _heft

if TYPE_CHECKING:
    import pandas

APPLICATION_ID = 0x48656674  # "Heft" in ASCII


def read_log(path: str | os.PathLike[str],
             tables: Iterable[str] | None = None) -> dict[str, pandas.DataFrame]:
    """The tables and views of a log by name; src/record/README.md describes them.

    path: an SQLite file of Heft. Nothing is written to its folder; a session may be running.
    tables: the names of those to be read. None: all; frames of many sessions are large.

    Times are in s since the start of the session, and units are in the columns' names. The attribute
    attrs["units"] of a data frame is a dict of them. NULL is None or NaN, flags are 0 and 1.
    Integrity is not checked: `heft replay --db LOG` does that.
    Raises FileNotFoundError, or ValueError if the file is no log or has no such table.
    """
    import pandas

    units = _heft.column_units()
    frames = {}
    with _opened(Path(path)) as log:
        for name in _names(log, path) if tables is None else _chosen(tables, _names(log, path)):
            frame = pandas.read_sql_query(f'SELECT * FROM "{name}"', log)
            frame.attrs["units"] = {column: units[column] for column in frame if column in units}
            frames[name] = frame
    return frames


def _names(log: sqlite3.Connection, path: str | os.PathLike[str]) -> list[str]:
    try:
        is_log = log.execute("PRAGMA application_id").fetchone() == (APPLICATION_ID,)
    except sqlite3.DatabaseError:
        is_log = False
    if not is_log:
        raise ValueError(f"{os.fspath(path)} is no heft log: it belongs to another program or is "
                         "damaged")
    return [name for name, in log.execute(
        "SELECT name FROM sqlite_schema WHERE type IN ('table', 'view') AND name NOT LIKE 'sqlite_%'")]


def _chosen(tables: Iterable[str], known: list[str]) -> list[str]:
    chosen = list(tables)
    for name in chosen:
        if name not in known:
            raise ValueError(f"the log has no table {name!r}; expected {', '.join(known)}")
    return chosen


@contextmanager
def _opened(path: Path) -> Iterator[sqlite3.Connection]:
    """The log, read only. SQLite makes a -shm file beside a database where there is none, except for
    one that is declared immutable. Its last rows may be in a -wal file."""
    file = path.resolve(strict=True)
    wal, shm = (file.with_name(file.name + end) for end in ("-wal", "-shm"))
    with tempfile.TemporaryDirectory(prefix="heft-") as folder:
        how = "mode=ro" if shm.exists() else "immutable=1"
        if wal.exists() and wal.stat().st_size > 0 and not shm.exists():  # no session is running
            shutil.copy(wal, folder)
            file = Path(shutil.copy(file, folder))
            how = "mode=ro"
        with closing(sqlite3.connect(f"file:{quote(str(file))}?{how}", uri=True)) as log:
            log.execute("PRAGMA trusted_schema = OFF")
            yield log

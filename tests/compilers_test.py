"""Whether clang compiles every file without a warning, clang-tidy finds nothing in it, or clang-format would
not change it.

Run: python3 tests/compilers_test.py clang++|clang-tidy|clang-format BUILD [REGEX of files]
It skips (77) where that program is not installed. Precompiled headers are left out, so that each
file must include what it uses.
"""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def commands(build, files):
    """The entries of compile_commands.json, for clang."""
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        if "cmake_pch" in entry["file"] or not re.search(files, entry["file"]):
            continue
        words = shlex.split(entry["command"])
        # The compiler and its cache come first.
        words = words[next(i for i, word in enumerate(words) if word.startswith("-")):]
        while "-include" in words:
            at = words.index("-include")
            del words[at:at + 2]
        words = ["clang++"] + [word for word in words
                               if word not in ("-fpch-preprocess", "-Winvalid-pch")]
        yield dict(entry, command=shlex.join(words))


def compiled(entry):
    words = shlex.split(entry["command"])
    at = words.index("-o")
    del words[at:at + 2]
    return subprocess.run(words + ["-fsyntax-only", "-Werror"], cwd=entry["directory"],
                          capture_output=True, text=True)


def check_format(files):
    root = Path(__file__).resolve().parents[1]
    paths = [path for folder in ("src", "tests", "results") for path in sorted((root / folder).rglob("*"))
             if path.suffix in (".h", ".cpp") and re.search(files, str(path))]
    return subprocess.run(["clang-format", "--dry-run", "-Werror", *paths]).returncode


def main(program, build, files="."):
    if not shutil.which(program):
        print(f"{program} is not installed")
        return 77
    if program == "clang-format":
        return check_format(files)
    entries = list(commands(Path(build), files))
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")

        def tidied(entry):
            return subprocess.run(["clang-tidy", "--quiet", "-p", folder, entry["file"]],
                                  capture_output=True, text=True)

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            runs = pool.map(compiled if program == "clang++" else tidied, entries)
            faulty = 0
            for entry, run in zip(entries, runs):
                if run.returncode:
                    faulty += 1
                    print(entry["file"], run.stdout, run.stderr, sep="\n", flush=True)
    print(f"{len(entries)} files, {faulty} of them with findings")
    return 1 if faulty or not entries else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

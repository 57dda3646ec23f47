"""The READMEs: every command runs or at least parses, every path exists, every link leads to a file.

The commands of a README's sh blocks run in order in a scratch folder with the shipped protocols and a log of
simulated participants. What cannot run here is listed in NOT_RUN with the reason; its options must exist.

Run: python3 tests/cli/readme_test.py PATH_TO_HEFT
"""
import fnmatch
import functools
import importlib.util
import os
import re
import shlex
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path

from session_harness import PROTOCOLS, ROOT, SessionTest, commands_in, main


def tree():
    """All files and folders of the source tree, as paths from its root."""
    paths = []
    for folder, folders, files in os.walk(ROOT):
        folders[:] = [name for name in folders if not re.match(r"\.git$|build|__pycache__", name)]
        paths += [os.path.relpath(os.path.join(folder, name), ROOT) for name in folders + files]
    return sorted(paths)


TREE = tree()
READMES = [path for path in TREE if os.path.basename(path) == "README.md"]
# What a command line holds, and why it is not run. "heft" stands for "./heft" too.
NOT_RUN = [
    (r"^heft demo\b", "takes a minute; session_test.py runs it"),
    (r"heft test\b", "builds and runs all tests"),
    (r"^heft bench\b", "takes minutes; tests/results run each study with --quick"),
    (r"camera:\d", "needs a camera"),
    (r"\bcalibrate display\b", "needs a display and someone who measures it"),
    (r"--tracker mouse|^heft (run|resume)\b(?!.*--responder)", "needs a display and a participant"),
    (r"\budp:|\blsl\b", "needs a network"),
    (r"^cmake --(preset|build)|cpack", "compiles everything"),
    (r"^cmake --install", "install_test.py installs"),
    (r"^ctest\b.*\bdeb\b", "needs root and a network"),
    (r"^ctest\b", "runs tests"),
    (r"^PYTHONPATH=build/python ", "tests/python/examples_test.py runs it"),
    (r"^build-fuzz/", "is built by clang"),
    (r"^python3 (results|tests)/", "takes minutes, and writes into results/"),
    (r"^HEFT_STUDIES=", "takes minutes"),
]


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def blocks(text):
    """Language and contents of each block of code."""
    return re.findall(r"^ *```(\w*)\n(.*?)^ *```$", text, re.M | re.S)


def lines_of(block):
    """The commands of an sh block, continued lines joined, without comments; ./heft becomes heft."""
    for line in re.sub(r"\\\n\s*", " ", block).splitlines():
        line = re.sub(r"(^|\s)#( .*|$)", "", line).strip()
        if line:
            yield re.sub(r"(^|\s)\./heft\b", r"\1heft", line)


def commands(text):
    return [line for language, block in blocks(text) if language == "sh" for line in lines_of(block)]


def spans(text):
    """The `code` between blocks of code."""
    prose = re.sub(r"^ *```.*?^ *```$", "", text, flags=re.M | re.S)
    return re.findall(r"`([^`\n]+)`", prose)


def reason_not_to_run(line):
    return next((reason for pattern, reason in NOT_RUN if re.search(pattern, line)), None)


@functools.cache
def names_of_tests():
    folders = [path.split("/")[1] for path in TREE if re.fullmatch(r"tests/\w+", path)]
    names = [name.replace("${folder}", folder) for folder in folders
             for name in re.findall(r"add_test\(NAME (\S+)", text_of("tests/CMakeLists.txt"))]
    for path in TREE:
        if path.startswith("tests/") and path.endswith("_test.cpp"):
            names += map(".".join, re.findall(r"^(?:TEST\w*|RC_\w+)\((\w+),\s*(\w+)", text_of(path), re.M))
        elif path.startswith("tests/cli") and path.endswith("_test.py"):
            names.append("cli_" + Path(path).stem)
    return names


class Parsed(SessionTest):
    """Looks up commands that are not run."""

    def parse(self, line):
        words = shlex.split(line)
        while "=" in words[0] and not words[0].startswith("-"):
            words = words[1:]  # variables
        program = words[0]
        if program in ("heft", "./heft"):
            self.parse_heft(words[1:])
        elif program == "python3":
            self.assertIn(words[1], TREE)
        elif program in ("cmake", "ctest", "(cd"):
            self.parse_tools(words)
        elif program.startswith("build-fuzz/"):
            kind = program.rsplit("fuzz_")[-1]
            self.assertIn(f"tests/fuzz/corpus/{kind}", words)
            self.assertTrue((ROOT / "tests" / "fuzz" / "corpus" / kind).is_dir())
        elif program.startswith("build/tests/test_"):
            self.assertIn(words[1].removeprefix("--gtest_filter="), names_of_tests())
        else:
            self.fail(f"unknown command {program}: run it, or list it in NOT_RUN and look it up here")

    def parse_heft(self, words):
        if words[0] == "test":
            if len(words) > 1 and not words[1].startswith("-"):
                self.assertIn(f'"{words[1]}"', text_of("CMakePresets.json"))
            return self.parse_tools(words[1:])
        if words[0] == "bench":
            bench = Path(self.heft).with_name("heft-bench")
            if not bench.exists():
                return None  # the name is in results/, which tests/results hold to account
            return self.look_up([str(bench)], words[1:])
        return self.look_up([self.heft], words)

    def look_up(self, program, words):
        """The command and its options, in its --help."""
        names = []
        for word in words[:2]:  # a command, and a command of it
            known = subprocess.run([*program, *names, "--help"], capture_output=True, text=True).stdout
            listed = known.partition("\nCommands")[2] if names else known  # the program's: no heading
            if word in commands_in(listed):
                names.append(word)
            elif not names and re.fullmatch("[a-z][a-z-]*", word):
                self.fail(f"no command {word}")
        done = subprocess.run([*program, *names, "--help"], capture_output=True, text=True)
        for word in words:
            if word.startswith("--") and word != "--help":
                option = word.partition("=")[0]
                self.assertTrue(re.search(rf"(?<![\w-]){option}(?![\w-])", done.stdout),
                                f"{' '.join(['heft', *names])} has no {option}")

    def parse_tools(self, words):
        for option, value in zip(words, words[1:]):
            if option == "-R":
                self.assertTrue([name for name in names_of_tests() if re.search(value, name)], value)
            elif option == "-L" and not value.isupper():
                self.assertRegex(text_of("tests/CMakeLists.txt"), rf'LABELS "?[\w;]*\b{value}\b')
            elif option == "--preset":
                self.assertIn(f'"{value}"', text_of("CMakePresets.json"))
            elif option == "--component":
                self.assertRegex(text_of(".install/Install.cmake"), rf"heft_install\({value}\b")


# A block of code, which a sentence before it may save as a file or append to one.
STEP = re.compile(r"(?:(save|append) this (?:as|to) `([^`]+)`:\n\n)?^ *```(\w*)\n(.*?)^ *```", re.S | re.M | re.I)


class Commands(Parsed):
    def follow(self, name):
        shutil.copytree(PROTOCOLS, self.folder / "protocols")
        shutil.copy(PROTOCOLS / "quick.toml", self.folder / "paper.toml")
        (self.folder / "heft").symlink_to(self.heft)
        self.run_heft("simulate", PROTOCOLS / "paper.toml", "--participants", "2", "--seed", "1", "--db",
                      self.folder / "lab.db")
        text = text_of(name)
        for verb, file, language, block in STEP.findall(text):
            if file:
                with open(self.folder / file, "w" if verb.lower() == "save" else "a", encoding="utf-8") as out:
                    out.write(block)
            for line in lines_of(block) if language == "sh" else []:
                with self.subTest(line=line):
                    self.parse(line) if reason_not_to_run(line) else self.run_line(line)
            with self.subTest(block=block):
                if language == "sql":
                    self.query(block)
        self.run_python("".join(block for language, block in blocks(text) if language == "python"))
        in_r = "".join(block for language, block in blocks(text) if language == "r")
        if in_r and shutil.which("Rscript"):
            self.run_r(in_r)

    def query(self, sql):
        """Each query must return rows."""
        with sqlite3.connect(self.folder / "lab.db") as db:
            for statement in filter(str.strip, sql.split(";")):
                self.assertTrue(db.execute(statement).fetchall(), f"no rows: {statement}")

    def run_python(self, code):
        compile(code, "README", "exec")
        modules = re.findall(r"^(?:import|from) (\w+)", code, re.M)
        if code and all(importlib.util.find_spec(module) for module in modules):
            self.run_command([sys.executable, "-c", code])

    def run_r(self, code):
        packages = set(re.findall(r"\b(\w+)::", code)) | set(re.findall(r"library\((\w+)\)", code))
        load = "; ".join(f"loadNamespace('{package}')" for package in packages)
        if not load or subprocess.run(["Rscript", "-e", load], capture_output=True).returncode == 0:
            self.run_command(["Rscript", "-e", code])

    def run_line(self, line):
        words = shlex.split(line)
        if words[0] == "sqlite3":  # not every machine has it
            return self.query(words[-1])
        if "Rscript" in line and shutil.which("Rscript") is None:
            return None
        self.assertIn(words[0], ("heft", "cp", "(cd", "cd", "mkdir"), "list it in NOT_RUN, or run it here")
        return self.run_command(["bash", "-c", line])

    def run_command(self, words):
        path = f"{self.folder}:{os.environ['PATH']}"
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True,
                              env=dict(os.environ, PATH=path))
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])


def following(name):
    return lambda self: self.follow(name)


for readme in READMES:
    if blocks(text_of(readme)):
        setattr(Commands, "test_" + re.sub(r"\W", "_", readme), following(readme))


class Mentioned(Parsed):
    def test_commands_between_the_blocks_exist(self):
        for name in READMES:
            for span in spans(text_of(name)):
                if re.match(r"(\./)?heft [a-z]|python3 \w|ctest -|cmake --", span):
                    with self.subTest(readme=name, command=span):
                        self.parse(re.sub(r"^\./", "", span).replace("…", "").replace("...", ""))

    def test_the_readme_lists_every_command(self):
        listed = re.findall(r"`([\w-]+)`", " ".join(re.findall(r"^\| (`.*?) \|", text_of("README.md"), re.M)))
        commands = commands_in(self.run_heft("--help").stdout)
        self.assertGreater(len(commands), 15)
        for command in commands:
            self.assertIn(command, listed)


FILE = re.compile(r"[\w.*{},+-]+\.(h|cpp|py|md|toml|csv|svg|png|yaml|cmake|sh|R|inc|json|cff|html|in)")
PATH = re.compile(r"[A-Za-z_.][\w.*{},@+-]*(/[\w.*{},@+-]+)+/?|[a-z_]+/")


class Paths(SessionTest):
    def test_lengths_of_protocols_are_those_of_validate(self):
        rows = re.findall(r"^\| (`\S+\.toml`.*?) \|.*\| (.*trials) \|$", text_of("README.md"), re.M)
        said = {name: length for names, lengths in rows
                for name, length in zip(re.findall(r"[\w/]+\.toml", names), lengths.split(", and "), strict=True)}
        self.assertGreaterEqual(len(said), 4)
        for name, length in said.items():
            printed = self.run_heft("validate", PROTOCOLS / name).stdout
            mean, simulated = re.search(r"about (\d+) trials(?: \((\d+ to \d+) )?", printed).groups()
            self.assertEqual(length.removesuffix(" trials"), simulated or mean, name)

    def test_every_path_exists(self):
        stale = []
        for name in READMES:
            text = text_of(name)
            given = " ".join(commands(text)) + " ".join(re.findall(r"[Ss]ave this as `([^`]+)`", text))
            for span in dict.fromkeys(spans(text)):
                for token in span.split():
                    token = token.strip(",;:()\"'")
                    if (FILE.fullmatch(token) or PATH.fullmatch(token)) and token not in given:
                        stale += [f"{name}: {path}" for path in self.expanded(token)
                                  if not self.exists(path, os.path.dirname(name))]
        if stale:
            self.fail(f"{len(stale)} stale paths:\n" + "\n".join(stale))

    @staticmethod
    def expanded(token):
        """a.{h,cpp} as a.h and a.cpp; X, NAME and other words in capitals as *."""
        braces = re.fullmatch(r"(.*)\{(.*)\}(.*)", token)
        paths = [braces[1] + end + braces[3] for end in braces[2].split(",")] if braces else [token]
        return [re.sub(r"(?<![A-Za-z])(X(?=[A-Z./]|$)|[A-Z]{3,}(?![a-z]))|@\w+@", "*", path) for path in paths]

    def exists(self, path, folder):
        """A file or a folder, from the README's folder, the root, src, protocols or tests; File.h anywhere;
        folder/Name as Name.h, Name.cpp; a file that the program writes, whose name is a text of the source."""
        path = os.path.normpath(path)
        if path in ("README.md",) or path.startswith("build/"):
            return True
        places = {os.path.normpath(os.path.join(start, path)) for start in
                  (folder, "", "src", "protocols", "tests", "results")}
        if "/" not in path:
            places.add(f"*/{path}")
        for place in places:
            patterns = [place] + [place + end for end in (".h", ".cpp", ".py", ".toml")]
            if any(fnmatch.fnmatchcase(known, pattern) for known in TREE for pattern in patterns):
                return True
        return re.sub(r"\d+", "#", path) in self.written()

    @staticmethod
    @functools.cache
    def written():
        """File names in the texts of the source."""
        names = set()
        for path in TREE:
            if path.startswith(("src/", "results/")) and path.endswith((".cpp", ".h", ".R", ".py", ".sh")):
                texts = " ".join(re.findall(r'"([^"\n]*)"', text_of(path)))
                names |= set(re.findall(r"[\w./{}#-]+\.[a-zA-Z]+", re.sub(r"\{\w*\}|\d+", "#", texts)))
        return names

    def test_every_link_leads_to_a_file(self):
        for name in READMES:
            for target in re.findall(r"\]\((?!http)([^)#]+)\)", text_of(name)):
                self.assertTrue(((ROOT / name).parent / target).exists(), f"{name}: {target}")


if __name__ == "__main__":
    main(__name__)

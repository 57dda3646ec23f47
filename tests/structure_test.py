"""The source tree: who may include whom, which library belongs where, sizes of folders and files, words.

Run: python3 tests/structure_test.py  (from anywhere)
"""
import re
import subprocess
import unittest
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SRC = ROOT / "src"
STUDIES = ROOT / "results"

# The layer table of src/README.md. Folders of one row do not include each other. results/main.cpp alone,
# the program heft-bench, uses cli's command line.
ROWS_1_2 = {"base", "psychophysics", "inference", "experiment", "tasks", "physics", "tracking"}
ROW_3 = {"engine", "protocol", "record", "responders", "view"}
MAY_INCLUDE = {
    "base": set(),
    "psychophysics": {"base"},
    "inference": {"psychophysics", "base"},
    "experiment": {"psychophysics", "base"},
    "tasks": {"psychophysics", "experiment", "base"},
    "physics": {"base"},
    "tracking": {"base"},
    "engine": {"tasks", "experiment", "psychophysics", "base"},
    "protocol": {"tasks", "experiment", "base", "physics", "psychophysics", "tracking"},
    "record": {"tasks", "experiment", "psychophysics", "base"},
    "responders": {"tasks", "experiment", "psychophysics", "base"},
    "view": {"tasks", "experiment", "base", "tracking"},
    "window": {"view", "tasks", "experiment", "tracking", "base"},
    "apparatus": ROWS_1_2 | ROW_3 - {"engine"},
    "analysis": ROWS_1_2 | {"protocol", "record", "responders", "view"},
    "replay": ROWS_1_2 | ROW_3 | {"apparatus"},
    "session": ROWS_1_2 | ROW_3 | {"apparatus", "replay"},
    "population": ROWS_1_2 | ROW_3 | {"apparatus", "replay", "session", "analysis"},
}
# window is loaded at run time, and no other folder includes it.
MAY_INCLUDE["results"] = MAY_INCLUDE["cli"] = MAY_INCLUDE["python"] = set(MAY_INCLUDE) - {"window"}

# Third-party headers that stay inside one folder or two; what is only compared with is in results.
LIBRARY_FOLDERS = {
    r"bullet/|btBullet|Bullet": {"physics", "results"},
    r"apriltag": {"tracking"},
    r"cairo": {"tracking"},
    r"pango": {"view"},
    r"ode/|mujoco": {"results"},
    r"opencv": {"tracking", "view", "results"},
    r"SDL|imgui|GL/": {"window"},
    r"SQLiteCpp|sqlite3": {"record"},
    r"toml": {"protocol"},
    r"yaml-cpp": {"tracking"},
    r"nlopt": {"inference"},
    r"CLI/": {"cli"},
    r"pybind11": {"python"},
}

ROOT_NAMES = {"CMakeLists.txt", "CMakePresets.json", "src", "protocols", "tests", "results",
              "README.md", "LICENSE", "CITATION.cff", "heft"}


def sources():
    return sorted(p for folder in (SRC, STUDIES) for p in folder.rglob("*") if p.suffix in {".h", ".cpp"})


def files_in(top):
    """All files below a folder but what is hidden, built or cached."""
    return [path for path in sorted(top.rglob("*")) if path.is_file()
            and not re.search(r"(^|/)(\.|build|__pycache__)", str(path.relative_to(top)))]


def folder_of(path):
    return path.relative_to(SRC if SRC in path.parents else ROOT).parts[0]


def sub_folder_of(path):
    """layer/sub-folder; none for a layer's own files."""
    parts = path.relative_to(SRC if SRC in path.parents else ROOT).parts
    return Path(*parts[:2]) if len(parts) > 2 else None


def may_include(path):
    folder = folder_of(path)
    return MAY_INCLUDE[folder] | ({"cli"} if path == STUDIES / "main.cpp" else set())


def includes(path):
    pattern = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
    return pattern.findall(path.read_text(encoding="utf-8"))


class Structure(unittest.TestCase):
    def test_every_folder_is_a_known_layer(self):
        self.assertLessEqual({folder_of(p) for p in sources()}, set(MAY_INCLUDE))

    def test_includes_point_down_the_layers(self):
        for path in sources():
            folder = folder_of(path)
            for quote, target in includes(path):
                if quote == '"':
                    other = target.split("/")[0]
                    with self.subTest(file=str(path.relative_to(ROOT)), includes=target):
                        self.assertTrue(((ROOT if other == "results" else SRC) / target).exists(),
                                        "write \"folder/File.h\" for files of src, and"
                                        " \"results/File.h\" for those of studies")
                        self.assertTrue(other == folder or other in may_include(path),
                                        f"{folder} may not include {other}")

    def test_sub_folders_do_not_include_each_other_in_circles(self):
        """A layer's own files, such as an interface and the list of what has it, may."""
        uses = {}
        for path in sources():
            own = sub_folder_of(path)
            for quote, target in includes(path):
                if own and quote == '"' and (SRC / target).exists():
                    other = sub_folder_of(SRC / target)
                    if other and other != own and other.parent == own.parent:
                        uses.setdefault(own, {})[other] = f"{path.relative_to(ROOT)} includes {target}"
        while leaves := [one for one in uses if not set(uses[one]) & set(uses)]:
            for one in leaves:
                del uses[one]
        circles = [why for used in uses.values() for other, why in used.items() if other in uses]
        self.assertEqual(circles, [])

    def test_a_name_is_one_type(self):
        """One name for two types makes a program with two definitions of it, and no error."""
        defined = re.compile(r"^(?:class|struct|enum class)\s+(\w+)(?:\s+final)?\s*(?::[^;{]*)?\{", re.M)
        where = {}
        for path in sources():
            if path.suffix == ".h" and "namespace heft {" in path.read_text(encoding="utf-8"):
                for name in defined.findall(path.read_text(encoding="utf-8")):
                    where.setdefault(name, []).append(str(path.relative_to(ROOT)))
        for name, paths in where.items():
            with self.subTest(name=name):
                self.assertEqual(len(paths), 1, f"{name} is defined in {paths}")

    def test_libraries_stay_in_their_folders(self):
        for path in sources():
            for quote, target in includes(path):
                if quote == '"':
                    continue
                for library, folders in LIBRARY_FOLDERS.items():
                    if re.match(library, target):
                        with self.subTest(file=str(path.relative_to(ROOT)), includes=target):
                            self.assertIn(folder_of(path), folders)

    def test_targets_link_only_what_they_may_use(self):
        text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        linked = dict(re.findall(r"heft_\w+\((\w+) USES ([^)]*)\)", text))
        self.assertIn("responders", linked)
        self.assertIn("cli", linked)
        for folder, uses in linked.items():
            if folder in MAY_INCLUDE:
                with self.subTest(folder=folder):
                    folders = {use for use in uses.split() if use in MAY_INCLUDE}
                    self.assertLessEqual(folders, MAY_INCLUDE[folder])
        self.assertNotIn("physics", linked["responders"].split())

    def test_one_file_reads_the_command_line(self):
        """CLI11's header costs seconds wherever it is included."""
        users = [path for path in sources() if any(target.startswith("CLI/")
                                                   for _, target in includes(path))]
        self.assertEqual(users, [SRC / "cli" / "CommandLine.cpp"])

    def test_psychophysics_is_pure(self):
        allowed = re.compile(r"^([a-z_0-9]+|fmt/format\.h|Eigen/Core)$")  # standard library, messages, arrays
        impure = {"fstream", "iostream", "chrono", "ctime", "random", "thread", "cstdio", "filesystem"}
        for path in sources():
            if folder_of(path) != "psychophysics":
                continue
            for quote, target in includes(path):
                with self.subTest(file=str(path.relative_to(ROOT)), includes=target):
                    if quote == "<":
                        self.assertRegex(target, allowed)
                        self.assertNotIn(target, impure)

    def test_sql_is_written_in_record_alone(self):
        sql = re.compile(r"\b(SELECT .+ FROM|INSERT INTO|CREATE TABLE|UPDATE \w+ SET|DELETE FROM)\b")
        for path in sources():
            if folder_of(path) != "record":
                with self.subTest(file=str(path.relative_to(ROOT))):
                    self.assertIsNone(sql.search(path.read_text(encoding="utf-8")))

    def test_root_holds_what_the_design_allows(self):
        listed = subprocess.run(["git", "-C", str(ROOT), "ls-files"], capture_output=True, text=True)
        names = {line.split("/")[0] for line in listed.stdout.splitlines()}
        self.assertEqual({n for n in names if not n.startswith(".")} - ROOT_NAMES, set())

    def test_folders_are_small(self):
        counts = Counter(path.parent for top in (SRC, STUDIES, ROOT / "tests") for path in files_in(top))
        for folder, n_files in counts.items():
            with self.subTest(folder=str(folder.relative_to(ROOT))):
                self.assertLessEqual(n_files, 25)

    def test_files_are_neither_long_nor_tiny(self):
        n_tiny = 0
        for path in sources():
            n_lines = len(path.read_text(encoding="utf-8").splitlines())
            n_tiny += n_lines <= 50 and SRC in path.parents
            with self.subTest(file=str(path.relative_to(ROOT))):
                self.assertLessEqual(n_lines, 400)
        self.assertLessEqual(n_tiny, 84, "files of 50 lines or less in src; the goal is 80")

    def test_the_readme_is_short(self):
        self.assertLessEqual((ROOT / "README.md").stat().st_size, 8192)


class PlainWords(unittest.TestCase):
    """The left column of the style guide's table of words, where a pattern cannot mean anything else."""
    WORDS = re.compile("|".join([
        r"\btold\b", r"\btells?\b", r"\bin force\b", r"\b(?:goes|go|going|gone|went) on\b",
        r"\bgone through\b", r"\b(?:is|are|was) over(?=[.,;:!?)]| and| before)", r"\bwhoever\b",
        r"\b(?:no|some|any)body\b", r"\bof (?:its|their) own\b", r"\bby (?:itself|themselves)\b",
        r"\banew\b", r"(?<!\ball )\bat once\b", r"\bwhat is not there\b", r"\bbears?\b", r"\bunsettled\b",
        r"\bwhat was counted first\b", r"\bwrong cube\b", r"\bright sortings?\b", r"\bimpossible answers?\b",
        r"\bwhich label which cube\b", r"\bcut by bounds\b", r"\bmisfortunes?\b", r"\bGoneThrough\b",
        r"\bAskedModel\b", r"\bWhatHappened\b", r"\bHappenings?\b", r"\bdeepest_push\b",
        r"\b(?:class|struct|enum class) (?:Setup|Noticed|Judging|Mind|Slid|Finish|Unseen|Fold)\b",
    ]), re.I)

    # In the parts of a name: goes_on, GoesOn.
    IN_NAMES = re.compile(r"\b(?:told|tells?|(?:goes|go|going|gone|went) on|whoever|anybody|nobody)\b", re.I)

    @classmethod
    def found_in(cls, line, is_code):
        parts = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", line).replace("_", " ") if is_code else ""
        return cls.WORDS.findall(line) or cls.IN_NAMES.findall(parts)

    def test_sources_and_readmes_use_them(self):
        pages = [path for path in files_in(ROOT) if path.name == "README.md"]
        pages = [path for path in pages if path != SRC / "record" / "README.md"]  # lists renamed words
        found = [f'{path.relative_to(ROOT)}:{number}: "{word}"'
                 for path in pages + [path for path in files_in(SRC) if path.suffix != ".md"]
                 if path.name != "Upgrade.cpp"  # renames words of older logs
                 for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
                 for word in self.found_in(line, path.suffix != ".md")]
        if found:
            self.fail(f"{len(found)} places:\n" + "\n".join(found))

    def test_names_of_tests_use_them(self):
        names = re.compile(r"(?:TEST(?:_F|_P)?|RC_GTEST\w*)\(\s*\w+,\s*(\w+)|def (test_\w+)")
        for path in files_in(ROOT / "tests"):
            if path.suffix in (".cpp", ".py"):
                for name in names.findall(path.read_text(encoding="utf-8")):
                    with self.subTest(file=str(path.relative_to(ROOT))):
                        self.assertEqual(self.found_in("".join(name), is_code=True), [])


if __name__ == "__main__":
    unittest.main()

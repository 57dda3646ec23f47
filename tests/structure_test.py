"""The house: who may include whom, which library lives where, what the root holds.

Run: python3 tests/structure_test.py  (from anywhere)
"""
import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SRC = ROOT / "src"
STUDIES = ROOT / "results"

# The layer table of src/README.md. Rooms on one row don't include each other; results/main.cpp
# alone, the program heft-bench, stands on cli's command line.
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
}
# window is loaded when it is asked for, and included by nobody.
MAY_INCLUDE["results"] = MAY_INCLUDE["cli"] = set(MAY_INCLUDE) - {"window"}

# Third-party headers that stay inside one room (or two); what is compared with stands in results.
LIBRARY_ROOMS = {
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
}

ROOT_NAMES = {"CMakeLists.txt", "CMakePresets.json", "src", "protocols", "tests", "results",
              "README.md", "LICENSE", "CITATION.cff", "heft"}


def sources():
    return sorted(p for folder in (SRC, STUDIES) for p in folder.rglob("*") if p.suffix in {".h", ".cpp"})


def room_of(path):
    return path.relative_to(SRC if SRC in path.parents else ROOT).parts[0]


def may_include(path):
    room = room_of(path)
    return MAY_INCLUDE[room] | ({"cli"} if path == STUDIES / "main.cpp" else set())


def includes(path):
    pattern = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
    return pattern.findall(path.read_text(encoding="utf-8"))


class Structure(unittest.TestCase):
    def test_every_folder_is_a_known_room(self):
        self.assertLessEqual({room_of(p) for p in sources()}, set(MAY_INCLUDE))

    def test_includes_point_down_the_layers(self):
        for path in sources():
            room = room_of(path)
            for quote, target in includes(path):
                if quote == '"':
                    other = target.split("/")[0]
                    with self.subTest(file=str(path.relative_to(ROOT)), includes=target):
                        self.assertTrue(((ROOT if other == "results" else SRC) / target).exists(),
                                        "include our files from src/: \"room/File.h\"; those of"
                                        " studies from the root: \"results/File.h\"")
                        self.assertTrue(other == room or other in may_include(path),
                                        f"{room} may not include {other}")

    def test_a_name_is_one_type(self):
        """Two rooms with one name make one program with two meanings of it, and no error."""
        defined = re.compile(r"^(?:class|struct|enum class)\s+(\w+)(?:\s+final)?\s*(?::[^;{]*)?\{", re.M)
        where = {}
        for path in sources():
            if path.suffix == ".h" and "namespace heft {" in path.read_text(encoding="utf-8"):
                for name in defined.findall(path.read_text(encoding="utf-8")):
                    where.setdefault(name, []).append(str(path.relative_to(ROOT)))
        for name, paths in where.items():
            with self.subTest(name=name):
                self.assertEqual(len(paths), 1, f"{name} is defined in {paths}")

    def test_libraries_stay_in_their_rooms(self):
        for path in sources():
            for quote, target in includes(path):
                if quote == '"':
                    continue
                for library, rooms in LIBRARY_ROOMS.items():
                    if re.match(library, target):
                        with self.subTest(file=str(path.relative_to(ROOT)), includes=target):
                            self.assertIn(room_of(path), rooms)

    def test_targets_link_only_what_they_may_use(self):
        text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        linked = dict(re.findall(r"heft_room\((\w+)(?: USES ([^)]*))?\)", text))
        self.assertIn("responders", linked)
        self.assertIn("cli", linked)
        for room, uses in linked.items():
            if room in MAY_INCLUDE:
                with self.subTest(room=room):
                    rooms = {use for use in uses.split() if use in MAY_INCLUDE}
                    self.assertLessEqual(rooms, MAY_INCLUDE[room])
        self.assertNotIn("physics", linked["responders"].split())

    def test_one_file_reads_the_command_line(self):
        """CLI11's header costs seconds wherever it is included."""
        users = [path for path in sources() if any(target.startswith("CLI/")
                                                   for _, target in includes(path))]
        self.assertEqual(users, [SRC / "cli" / "CommandLine.cpp"])

    def test_psychophysics_is_pure(self):
        allowed = re.compile(r"^([a-z_0-9]+|fmt/format\.h)$")  # the standard library, and messages
        impure = {"fstream", "iostream", "chrono", "ctime", "random", "thread", "cstdio", "filesystem"}
        for path in sources():
            if room_of(path) != "psychophysics":
                continue
            for quote, target in includes(path):
                with self.subTest(file=str(path.relative_to(ROOT)), includes=target):
                    if quote == "<":
                        self.assertRegex(target, allowed)
                        self.assertNotIn(target, impure)

    def test_sql_is_written_in_record_alone(self):
        sql = re.compile(r"\b(SELECT .+ FROM|INSERT INTO|CREATE TABLE|UPDATE \w+ SET|DELETE FROM)\b")
        for path in sources():
            if room_of(path) != "record":
                with self.subTest(file=str(path.relative_to(ROOT))):
                    self.assertIsNone(sql.search(path.read_text(encoding="utf-8")))

    def test_root_holds_what_the_design_allows(self):
        listed = subprocess.run(["git", "-C", str(ROOT), "ls-files"], capture_output=True, text=True)
        names = {line.split("/")[0] for line in listed.stdout.splitlines()}
        self.assertEqual({n for n in names if not n.startswith(".")} - ROOT_NAMES, set())

    def test_no_file_is_a_crowded_room(self):
        for path in sources():
            with self.subTest(file=str(path.relative_to(ROOT))):
                n_lines = len(path.read_text(encoding="utf-8").splitlines())
                self.assertLessEqual(n_lines, 400)


if __name__ == "__main__":
    unittest.main()

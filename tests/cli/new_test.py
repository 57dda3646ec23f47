"""heft new: its files compile or are valid, its test fails with the stated reason, and a refused name
changes nothing.

Run: python3 tests/cli/new_test.py PATH_TO_HEFT
With HEFT_WHOLE_BUILD=1 also: build a copy of the source with one new entry of each kind and run all tests.
"""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
import unittest
from pathlib import Path

from session_harness import PROTOCOLS, ROOT, SessionTest, main

FAILING = {
    "task": ("odd_one_out", "OddOneOut.SimulatedParticipantsAnswerByWhatTheyPerceived"),
    "procedure": ("accelerated", "Accelerated.FindsTheThresholdOfAnObserverWithoutNoise"),
    "technique": ("stick", "Stick.DisplacesTheCloneThatPushesACube"),
    "responder": ("hasty", "Hasty.AnswersByWhichCubeIsHeavier"),
    "simulator": ("springs", "SpringsSimulator.PushesACubeAlong"),
}


class New(SessionTest):
    def checkout(self):
        """A copy of the source."""
        copy = self.folder / "checkout"
        shutil.copytree(ROOT, copy, symlinks=True, ignore=shutil.ignore_patterns("build*", ".git"))
        return copy

    def new(self, kind, name, folder, expect=0, **environment):
        done = self.run_heft("new", kind, name, expect=expect, cwd=folder,
                             env=dict(os.environ, **environment))
        return done.stdout if expect == 0 else done.stderr

    @staticmethod
    def contents(folder):
        return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class Experiment(New):
    def test_is_valid_in_any_folder_and_runs(self):
        said = self.new("experiment", "soft-cubes_2", self.folder)
        self.assertIn("heft validate soft-cubes_2.toml", said)
        self.assertIn('title = "soft-cubes_2"', (self.folder / "soft-cubes_2.toml").read_text())
        self.run_heft("validate", "soft-cubes_2.toml", cwd=self.folder)
        self.run_heft("run", "soft-cubes_2.toml", "--participant", "1", "--responder", "simulated", "--seed",
                      1, "--db", "lab.db", cwd=self.folder)

    def test_an_existing_file_and_a_path_are_refused(self):
        self.new("experiment", "mine", self.folder)
        before = self.contents(self.folder)
        self.assertIn("mine.toml exists already", self.new("experiment", "mine", self.folder, expect=1))
        for name in ("a/b", "../a", "mine.toml", ".hidden", "two words"):
            self.assertIn(f'"{name}" is not a name', self.new("experiment", name, self.folder, expect=2))
        self.assertEqual(self.contents(self.folder), before)


class Code(New):
    def test_one_of_each_compiles_without_warnings(self):
        copy = self.checkout()
        sources = []
        for kind, (name, test) in FAILING.items():
            said = self.new(kind, name, copy / "src" / "tasks")
            self.assertIn(test, said)
            changed = re.findall(r"^(?:wrote|changed) +(\S+)$", said, re.M)
            self.assertGreaterEqual(len(changed), 3, said)
            sources += [path for path in changed if path.endswith((".h", ".cpp"))]
        for path in sources:
            self.assertNotRegex((copy / path).read_text(encoding="utf-8"), r"@\w+@", path)
        for language in ("en", "fr"):
            texts = tomllib.loads((copy / f"protocols/texts/{language}.toml").read_text(encoding="utf-8"))
            self.assertLessEqual({"trial_odd_one_out", "instructions_odd_one_out"}, set(texts))
        done = subprocess.run([sys.executable, copy / "tests" / "structure_test.py"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])
        # Together, as most of a file's time is its headers'.
        whole = copy / "all.cpp"
        whole.write_text("".join(f'#include "{copy / path}"\n' for path in sorted(set(sources))))
        done = subprocess.run(self.syntax_check(whole), capture_output=True, text=True,
                              cwd=copy / "build")
        self.assertEqual(done.returncode, 0, done.stderr[:5000])

    def syntax_check(self, source):
        """How the tests' files are compiled, for a file of the copy that the build does not know."""
        commands = json.loads((Path(self.heft).parent / "compile_commands.json").read_text())
        sibling = next(one for one in commands if one["file"].endswith("tests/tasks/every_task_test.cpp"))
        text = re.sub(r"-include \S*cmake_pch\S*|-Winvalid-pch|-fpch-preprocess", "", sibling["command"])
        words = shlex.split(text)
        while "ccache" in words[0]:
            words = words[1:]
        del words[words.index("-o"):]
        (source.parent / "build").mkdir()
        words = [word.replace(str(ROOT), str(source.parent)) for word in words]
        return words + ["-Werror", "-fsyntax-only", str(source)]

    def test_names_that_cannot_be_are_refused_and_nothing_changes(self):
        copy = self.checkout()
        before = self.contents(copy)
        for name in ("Odd", "odd-one", "1st", "odd__one", "_odd", "odd one", "x" * 41, "../odd"):
            self.assertIn("is not a name for source code", self.new("task", name, copy, expect=2))
        for kind, name, taken in (("task", "sorting", "Sorting.h"), ("responder", "coin", '"coin"'),
                                  ("simulator", "quasi_static", '"quasi_static"'), ("technique", "gain", "Gain.h"),
                                  ("procedure", "constant", "Constant.h"), ("task", "action", "Action")):
            self.assertIn(taken, self.new(kind, name, copy, expect=1))
        # A list that is not where it is expected: found before anything is written.
        tasks = copy / "src/tasks/Tasks.h"
        tasks.write_text(tasks.read_text().replace("using Tasks", "using AllTasks"))
        before[tasks] = tasks.read_bytes()
        self.assertIn("Tasks.h has no", self.new("task", "odd_one_out", copy, expect=1))
        # A folder where a file has to be written: found while writing.
        blocked = copy / "tests/physics/springs_test.cpp.heft-new"
        blocked.mkdir()
        self.assertIn("springs_test.cpp", self.new("simulator", "springs", copy, expect=1))
        blocked.rmdir()
        self.assertEqual(self.contents(copy), before)
        self.assertFalse((copy / "src/physics/springs").exists())

    def test_it_needs_a_checkout(self):
        for kind in FAILING:
            self.assertIn("HEFT_CHECKOUT", self.new(kind, "odd", self.folder, expect=1, HEFT_CHECKOUT=""))
        self.assertIn("not a checkout", self.new("task", "odd", self.folder, expect=1,
                                                 HEFT_CHECKOUT=str(self.folder)))
        copy = self.checkout()
        self.new("technique", "stick", self.folder, HEFT_CHECKOUT=str(copy))
        self.assertTrue((copy / "src/physics/techniques/Stick.h").exists())

    def test_the_template_of_experiments_is_valid(self):
        self.run_heft("validate", PROTOCOLS / "examples/template.toml")


@unittest.skipUnless(os.environ.get("HEFT_WHOLE_BUILD"), "compiles everything: ctest -L slow -R new")
class WholeBuild(New):
    def test_only_the_new_tests_fail_and_each_says_what_to_write(self):
        copy = self.checkout()
        for kind, (name, _) in FAILING.items():
            self.new(kind, name, copy)
        for command in (["cmake", "--preset", "release", "-DHEFT_TESTS=ON"], ["cmake", "--build", "build"]):
            done = subprocess.run(command, cwd=copy, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout[-5000:] + done.stderr[-5000:])
        done = subprocess.run(["ctest", "--test-dir", "build", "-LE", "slow", "-E", "^install$|^cli_new_test$",
                               "-j", str(os.cpu_count() + 2), "--output-on-failure"], cwd=copy,
                              capture_output=True, text=True)
        failed = (copy / "build/Testing/Temporary/LastTestsFailed.log").read_text()
        names = [line.split(":", 1)[1] for line in failed.splitlines()]
        self.assertCountEqual(names, [test for _, test in FAILING.values()], done.stdout[-20000:])
        for name, _ in FAILING.values():
            self.assertRegex(done.stdout, rf"{name} .* yet")


if __name__ == "__main__":
    main(__name__)

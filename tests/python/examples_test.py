"""The examples for other languages in protocols/examples: Python, Node and R.

Node and R are tested where they are installed. Run: python3 tests/python/examples_test.py build/heft
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import heft

PROGRAM = Path(sys.argv.pop(1)).resolve()
PROTOCOLS = Path(__file__).resolve().parents[2] / "protocols"
EXAMPLES = PROTOCOLS / "examples"


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=120,
                          env=os.environ | {"HEFT": str(PROGRAM)})


def has_r():
    return shutil.which("Rscript") and run(
        "Rscript", "-e", "loadNamespace('DBI'); loadNamespace('RSQLite')").returncode == 0


class Examples(unittest.TestCase):
    def printed(self, *words):
        done = run(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        return done.stdout

    def assert_estimates(self, text):
        """Near the observer's threshold of 62 g."""
        estimates = dict(re.findall(r"(?m)^(\w+): ([\d.]+) g after \d+ trials$", text))
        self.assertEqual(estimates.keys(), {"15g", "65g"})
        for estimate in estimates.values():
            self.assertAlmostEqual(float(estimate), 62, delta=5)

    def test_python(self):
        text = self.printed(sys.executable, EXAMPLES / "staircase_loop.py")
        self.assertRegex(text, r"(?m)^  1  (15g   175|65g   200)\.0 g  True$")
        self.assert_estimates(text)

    @unittest.skipUnless(shutil.which("node"), "Node is not installed (package nodejs)")
    def test_node_gets_the_same_trials_as_python(self):
        text = self.printed("node", EXAMPLES / "staircase_loop.mjs")
        trials = [(int(number), name, float(level)) for number, name, level in
                  re.findall(r"(?m)^(\d+) (\w+) ([\d.]+) g (?:true|false)$", text)]
        in_python = re.findall(r"(?m)^ +(\d+)  (\w+) +([\d.]+) g",
                               self.printed(sys.executable, EXAMPLES / "staircase_loop.py"))
        self.assertEqual([(number, name) for number, name, _ in trials],
                         [(int(number), name) for number, name, _ in in_python])
        for (*_, level), (*_, rounded) in zip(trials, in_python):
            self.assertAlmostEqual(level, float(rounded), delta=0.051)
        self.assert_estimates(text)

    @unittest.skipUnless(has_r(), "R with DBI and RSQLite is not installed (package r-cran-rsqlite)")
    def test_r(self):
        with tempfile.TemporaryDirectory() as folder:
            log = heft.simulate(PROTOCOLS / "jnd.toml", 2, 1, Path(folder) / "lab.db")
            before = log.read_bytes()
            text = self.printed("Rscript", EXAMPLES / "read_log.R", log)
            self.assertEqual(log.read_bytes(), before)
            trials = heft.read_log(log, ["v_trial", "v_jnd"])
            n = (trials["v_trial"].status.eq("completed") & trials["v_trial"].is_practice.eq(0)).sum()
            self.assertIn(f"{n} completed trials", text)
            for jnd in trials["v_jnd"].jnd_g.dropna():
                self.assertIn(f"{jnd:.3f}"[:-1], text)


if __name__ == "__main__":
    unittest.main()

"""Hardening of the programs and modules, which open untrusted logs, pictures and protocols.

Run: python3 tests/install/hardening_test.py BUILD
"""
import subprocess
import sys
import unittest
from pathlib import Path

NAMES = ["heft", "heft-bench", "heft-window.so", "heft-codecs.so"]


def readelf(*words):
    return subprocess.run(["readelf", *words], capture_output=True, text=True, check=True).stdout


class Hardening(unittest.TestCase):
    build = None

    def each(self):
        for file in [*(self.build / name for name in NAMES), *self.build.glob("python/heft/*.so")]:
            with self.subTest(file.name):
                yield file

    def test_programs_are_position_independent(self):
        for file in self.each():
            self.assertIn("DYN (", readelf("-hW", file))

    def test_addresses_of_functions_are_read_only(self):
        for file in self.each():
            self.assertIn("GNU_RELRO", readelf("-lW", file))
            self.assertRegex(readelf("-dW", file), r"BIND_NOW|FLAGS_1.*NOW")

    def test_no_memory_is_writable_and_executable(self):
        for file in self.each():
            stack = [line for line in readelf("-lW", file).splitlines() if "GNU_STACK" in line]
            self.assertTrue(stack and " RWE" not in stack[0], stack)

    def test_the_loader_searches_no_folder_of_the_files(self):
        for file in self.each():
            self.assertNotRegex(readelf("-dW", file), r"R(UN)?PATH")

    def test_buffers_and_stacks_are_checked(self):
        for file in self.each():
            used = readelf("--dyn-syms", "-W", file)
            self.assertIn("__stack_chk_fail", used)
        self.assertRegex(readelf("--dyn-syms", "-W", self.build / "heft"), r"__\w+_chk\b")


if __name__ == "__main__":
    Hardening.build = Path(sys.argv.pop(1))
    unittest.main()

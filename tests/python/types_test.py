"""The module's type hints and docstrings.

Run: PYTHONPATH=build/python python3 tests/python/types_test.py build/heft
"""
import ast
import inspect
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import heft
from heft import _heft

PACKAGE = Path(heft.__file__).parent


def members(of):
    return {name for name in vars(of) if not name.startswith("_") or name == "__init__"}


class Types(unittest.TestCase):
    def test_the_stubs_are_those_of_the_compiled_part(self):
        tree = ast.parse((PACKAGE / "_heft.pyi").read_text())
        defined = {node.name: node for node in tree.body if hasattr(node, "name")}
        variables = {node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)}
        self.assertEqual(defined.keys() | variables, members(_heft))
        self.assertEqual({node.name for node in defined["Run"].body}, members(_heft.Run))
        for name, function in [("fit", _heft.fit), ("column_units", _heft.column_units)]:
            words = [word.arg for word in defined[name].args.args]
            self.assertEqual([word for word in words if f"{word}:" not in function.__doc__], [])

    def test_everything_public_is_typed_and_described(self):
        self.assertTrue((PACKAGE / "py.typed").exists())
        for name in heft.__all__:
            thing = getattr(heft, name)
            if not name.startswith("_"):
                self.assertTrue(inspect.getdoc(thing), name)
            functions = [thing] if inspect.isfunction(thing) else [
                one for key, one in vars(thing).items()
                if inspect.isfunction(one) and not key.startswith("_")
                and one.__module__.startswith("heft")] if inspect.isclass(thing) else []
            for function in functions:
                signature = inspect.signature(function)
                self.assertIsNot(signature.return_annotation, signature.empty, function)
                self.assertTrue(inspect.getdoc(function), function)

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_mypy(self):
        done = subprocess.run(["mypy", "--strict", "--ignore-missing-imports", "--cache-dir=/dev/null", "-p", "heft"],
                              cwd=PACKAGE.parent, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    sys.argv.pop(1)
    unittest.main()

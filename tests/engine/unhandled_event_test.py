"""An event payload that the engine does not fold, or whose fields have no columns, does not compile;
one that is only recorded needs no case in the engine.

python3 unhandled_event_test.py SOURCE_DIR COMPILER FLAG...
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, COMPILER = Path(sys.argv[1]), sys.argv[2:]
LAST = "AnswerVetoed>;"


class UnhandledEvent(unittest.TestCase):
    def compiled(self, source, declaration=None):
        """The compiler's exit code and messages with `declaration`, a struct LampChanged, listed."""
        with tempfile.TemporaryDirectory() as folder:
            header = (SOURCE / "src/experiment/Event.h").read_text()
            if declaration:
                self.assertEqual(header.count(LAST), 1)
                header = header.replace(LAST, "AnswerVetoed, LampChanged>;")
                header = header.replace("using EventPayload =", declaration + "\nusing EventPayload =")
            changed = Path(folder) / "experiment/Event.h"
            changed.parent.mkdir()
            changed.write_text(header)
            done = subprocess.run(
                [*COMPILER, "-std=c++20", "-fsyntax-only", f"-I{folder}", f"-I{SOURCE}/src",
                 str(SOURCE / "src" / source)], capture_output=True, text=True)
            return done.returncode, done.stderr

    def test_every_listed_payload_compiles(self):
        self.assertEqual(self.compiled("engine/Engine.cpp"), (0, ""))

    def test_a_payload_without_a_case_in_the_engine_does_not(self):
        code, messages = self.compiled("engine/Engine.cpp", self.lamp("setting"))
        self.assertNotEqual(code, 0)
        self.assertIn("LampChanged", messages)

    def test_unless_it_is_only_recorded(self):
        self.assertEqual(self.compiled("engine/Engine.cpp", self.lamp("recorded")), (0, ""))

    def test_a_field_without_columns_does_not(self):
        code, messages = self.compiled("record/schema/EventRow.cpp", self.lamp("recorded"))
        self.assertNotEqual(code, 0)
        self.assertIn("event_columns", messages)

    @staticmethod
    def lamp(role):
        return ('struct LampChanged { static constexpr EventType event_type{"lamp", EventRole::%s};'
                " int watts = 0; bool operator==(const LampChanged&) const = default; };" % role)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

"""Whole sessions at four resolutions, by a simulated participant who sees pixels and uses a mouse.

Run: python3 tests/cli/window/whole_sessions_test.py path/to/heft
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from participant import Eyes, Participant
from session_harness import query
from window_test import HEFT, Screen

PROTOCOL = """title = "Short"
display_rate_hz = 5  # software rendering of 3840 x 2160 pixels takes a while
[[block]]
kind = "sorting"
name = "sorting"
masses_g = [15, 200, 800]
trials = { C2 = 1 }
[[block]]
kind = "comparison"
name = "comparison"
condition = "C2"
practice = { trials = 2, feedback = true }
[[block.staircase]]
name = "200g"
kind = "constant"
reference_g = 200
levels = [0, 300, 600]
n_per_level = 1
"""
LABELS = ["lightest", "intermediate", "heaviest"]


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool"), "needs Xvfb and xdotool")
class WholeSessions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.db = str(self.folder / "log.db")
        self.protocol = self.folder / "short.toml"
        self.protocol.write_text(PROTOCOL, encoding="utf-8")

    def heft(self, *words):
        done = subprocess.run([HEFT, *words, "--db", self.db], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def session(self, size, language, text_size):
        screen = Screen(size, self.folder)
        self.addCleanup(screen.close)
        program = subprocess.Popen(
            [HEFT, "run", str(self.protocol), "--participant", "07", "--db", self.db, "--seed", "5",
             "--purpose", "test", "--tracker", "mouse", "--language", language, "--text-size",
             str(text_size), "--ignore-failed-checks"], env=screen.environment(), text=True,
            stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(program.kill)
        person = Participant(screen, Eyes(self.folder, size), lambda: program.poll() is not None)
        person.read_on()
        person.push(1)
        person.sort([2, 0, 1])
        for choices in ([2, 1], [0, 1, 2]):  # practice, then what counts
            person.read_on()
            for n in choices:
                person.choose(n)
        person.finish()
        _, talk = program.communicate(timeout=60)
        self.assertEqual(program.returncode, 0, talk)
        self.check()

    def check(self):
        self.assertEqual(query(self.db, "select state from session"), [("finished",)])
        self.assertEqual(
            query(self.db, "select action, slot, label from answer order by answer_id"),
            [("label", slot, LABELS[label]) for slot, label in ((1, 2), (2, 0), (3, 1))]
            + [("validate", None, None), ("no_difference", None, None), ("select", 2, None),
               ("select", 1, None), ("select", 2, None), ("no_difference", None, None)])
        self.assertEqual(query(self.db, "select is_practice, count(*) from trial group by 1"),
                         [(0, 4), (1, 2)])
        self.assertGreater(query(self.db, "select n_pushes from cube join trial using (trial_id) "
                                          "where task = 'sorting' and slot = 2")[0][0], 0)
        self.heft("replay")
        self.heft("analyse", "--out", str(self.folder / "report"))

    def test_on_7_inches_in_large_french_letters(self):
        self.session((1024, 600), "fr", 2)

    def test_on_1280_x_720_pixels(self):
        self.session((1280, 720), "en", 1)

    def test_on_1920_x_1080_pixels_in_french(self):
        self.session((1920, 1080), "fr", 1)

    def test_on_3840_x_2160_pixels_in_large_letters(self):
        self.session((3840, 2160), "en", 2)


if __name__ == "__main__":
    unittest.main()

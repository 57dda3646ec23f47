"""The experimenter's terminal during a person's session: its display and its keys.

Run: python3 tests/cli/console_test.py path/to/heft
"""
import fcntl
import os
import pty
import re
import select
import shutil
import signal
import sqlite3
import struct
import subprocess
import tempfile
import termios
import threading
import time
import unittest
from pathlib import Path

from session_harness import PROTOCOLS, query
from window_test import HEFT, Person, Screen

# What would tell the experimenter what the participant feels, or whether they were right.
TELLTALE = re.compile(r"\d\s?(g|kg|mg)\b|\bC[12]\b|correct|heaviest|lightest|staircase|level|catch",
                      re.I)


class Terminal:
    """A program at a terminal of its own; what it prints is kept."""

    def __init__(self, command, environment):
        self.keyboard, theirs = pty.openpty()
        self.program = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs,
                                        env=dict(environment, NO_COLOR="1"))
        os.close(theirs)
        self.shown = ""
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        while True:
            ready, _, _ = select.select([self.keyboard], [], [], 0.2)
            if not ready:
                if self.program.poll() is not None:
                    return
                continue
            try:
                part = os.read(self.keyboard, 4096)
            except OSError:  # the program has ended
                return
            self.shown += part.decode("utf-8", "replace")

    def press(self, keys):
        os.write(self.keyboard, keys.encode())

    def wait_for(self, condition, seconds=60):
        deadline = time.time() + seconds
        while time.time() < deadline:
            if condition():
                return True
            time.sleep(0.1)
        return False


class AtAConsole(unittest.TestCase):
    """A person's session whose experimenter sits at a terminal."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.db = str(self.folder / "console.db")

    # How fast pictures come is the machine's: it may be busy.
    HAND = ("--tracker", "hand", "--ignore-failed-checks")

    def start(self, *options, protocol=PROTOCOLS / "quick.toml"):
        self.start_as([str(protocol), "--participant", "07"], *options)

    def start_as(self, whom, *options):
        self.screen = Screen()
        self.addCleanup(self.screen.close)
        self.terminal = Terminal([HEFT, "run", *whom, "--db", self.db, "--seed", "5", "--purpose",
                                  "test", *options], self.screen.environment())
        self.addCleanup(self.end)
        self.person = Person(self.screen, self.db, self.terminal.program)

    def end(self):
        if self.terminal.program.poll() is None:
            self.terminal.program.kill()
        self.terminal.program.wait()
        self.terminal.reader.join()
        os.close(self.terminal.keyboard)

    def n(self, kind, more=""):
        rows = self.person.log(f"select count(*) from event where kind = '{kind}' {more}")
        return rows[0][0] if rows else 0

    def shows(self, words):
        self.assertTrue(self.terminal.wait_for(lambda: words in self.terminal.shown),
                        self.terminal.shown)


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool"), "needs Xvfb and xdotool")
class Console(AtAConsole):
    def setUp(self):
        super().setUp()
        self.start(*self.HAND)

    def until_a_sorting_trial_is_open(self):
        def is_open():
            self.person.take_part(1)
            trial = self.person.log("select 1 from trial where status = 'open' and "
                                    "task = 'sorting' and shown_s is not null")
            return bool(trial) or self.n("trial_started") > 2
        self.assertTrue(self.terminal.wait_for(is_open, 120), self.terminal.shown)

    def test_it_keeps_them_blind_until_they_ask_and_that_is_logged(self):
        self.until_a_sorting_trial_is_open()
        self.terminal.press("nthe door slammed at 5 o'clock\n")
        self.assertTrue(self.terminal.wait_for(lambda: self.n("note") == 1))
        self.shows("pictures/s")  # told once some pictures were counted
        before = self.terminal.shown
        self.assertIn("trials", before)
        self.assertIsNone(TELLTALE.search(before), TELLTALE.search(before))
        self.assertEqual(self.n("unblinding"), 0)
        self.terminal.press("un")  # a question first: any key but y takes it back
        time.sleep(0.5)
        self.assertEqual(self.n("unblinding"), 0)
        self.terminal.press("uy")
        self.assertTrue(self.terminal.wait_for(lambda: self.n("unblinding") == 1))
        shows_masses = lambda: TELLTALE.search(self.terminal.shown[len(before):])
        def sees():
            self.person.take_part(1)
            return shows_masses()
        self.assertTrue(self.terminal.wait_for(sees, 60), self.terminal.shown[len(before):])

    def test_its_keys_hold_the_session_void_a_trial_and_end_it(self):
        self.until_a_sorting_trial_is_open()
        self.terminal.press("p")
        self.assertTrue(self.terminal.wait_for(
            lambda: self.n("paused", "and detail = 'experimenter'") == 1))
        self.terminal.press("p")
        self.assertTrue(self.terminal.wait_for(lambda: self.n("continued") == 1))
        self.terminal.press("v2")
        self.assertTrue(self.terminal.wait_for(
            lambda: self.n("void", "and detail = 'veto: disturbance'") == 1 or
            "no trial is open" in self.terminal.shown))
        self.terminal.press("ey")
        self.assertTrue(self.terminal.wait_for(lambda: self.terminal.program.poll() is not None))
        self.assertEqual(self.terminal.program.returncode, 130)
        self.terminal.reader.join()
        self.assertIn("heft resume", self.terminal.shown)
        self.assertEqual(query(self.db, "select state from session"), [("paused",)])

    def test_a_locked_log_holds_the_session_and_says_so(self):
        self.until_a_sorting_trial_is_open()
        other = sqlite3.connect(self.db, isolation_level=None)
        other.execute("begin immediate")
        self.terminal.press("nwritten while it was locked\n")
        self.shows("Database locked by another process; retrying.")
        self.shows("noted; not saved yet")
        self.shows("PAUSED ITSELF")
        self.shows("\a")  # and it is heard
        time.sleep(7)  # longer than any timeout of a single write
        self.assertIsNone(self.terminal.program.poll(), self.terminal.shown)
        self.assertEqual(self.n("note"), 0)
        other.execute("rollback")
        other.close()
        self.assertTrue(self.terminal.wait_for(lambda: self.n("continued") == 1))
        self.assertEqual(self.n("paused", "and detail = 'database locked by another process'"), 1)
        self.assertEqual(self.n("note"), 1)
        self.assertTrue(self.terminal.wait_for(self.person.open_trial))
        self.terminal.press("ey")
        self.assertTrue(self.terminal.wait_for(lambda: self.terminal.program.poll() is not None))
        self.assertEqual(self.terminal.program.returncode, 130)

    def test_answers_in_a_locked_log_are_kept_and_can_be_vetoed(self):
        for ends_trial in (False, True):
            self.assertTrue(self.terminal.wait_for(self.untouched_sorting_trial, 120))
            trial_id = self.person.open_trial()[0]
            answers = lambda: self.person.n_answers(trial_id)
            time.sleep(1)  # the first moments of a page take no keys
            for key in "1l2i3h" if ends_trial else "":
                self.screen.key(key)
            self.assertTrue(self.terminal.wait_for(lambda: answers() == 3 * ends_trial))
            other = sqlite3.connect(self.db, isolation_level=None)
            other.execute("begin immediate")
            if ends_trial:
                self.screen.click("validate")
            else:
                self.screen.key("1")
                self.screen.key("l")
            self.assertTrue(self.terminal.wait_for(lambda: self.says_locked() == ends_trial + 1),
                            self.terminal.shown)
            self.terminal.press("v2")
            time.sleep(1)
            self.assertEqual(answers(), 3 * ends_trial)
            other.execute("rollback")
            other.close()
            self.assertTrue(self.terminal.wait_for(lambda: self.n("continued") == ends_trial + 1))
            # A frame's write may have met the lock first; then the session was paused earlier.
            was_taken = answers() - 3 * ends_trial
            self.assertIn(was_taken, (0, 1))
            status = "completed" if ends_trial and was_taken else "void"
            self.assertEqual(query(self.db, f"select status from trial where trial_id = {trial_id}"),
                             [(status,)])
            if status == "completed":
                self.shows("no trial is open; an answered trial stays as it is")
        self.terminal.press("ey")
        self.assertTrue(self.terminal.wait_for(lambda: self.terminal.program.poll() is not None))
        for command in (["replay"], ["resume", "--responder", "simulated", "--view", "headless"],
                        ["replay"]):
            done = subprocess.run([HEFT, *command, "--db", self.db], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)

    def untouched_sorting_trial(self):
        trial = self.person.open_trial()
        if not trial:
            self.screen.key("Return")
        elif trial[2] is not None:
            if trial[1] == "sorting" and self.person.n_answers(trial[0]) == 0:
                return True
            self.person.answer(*trial[:2])
        return False

    def says_locked(self):
        return self.terminal.shown.count("Database locked by another process; retrying.")

    def test_a_reason_can_be_typed_and_an_answer_taken_back_only_where_there_is_one(self):
        self.until_a_sorting_trial_is_open()
        self.terminal.press("vthe cat is on the table\n")
        self.assertTrue(self.terminal.wait_for(
            lambda: self.n("void", "and detail = 'veto: the cat is on the table'") == 1 or
            "no trial is open" in self.terminal.shown))
        self.terminal.press("x4")  # that of the introduction
        self.assertTrue(self.terminal.wait_for(lambda: self.n("answer_vetoed") == 1))
        self.terminal.press("x4")
        self.shows("there is no answered trial")
        self.terminal.press("r")
        self.terminal.press("ey")
        self.assertTrue(self.terminal.wait_for(lambda: self.terminal.program.poll() is not None))
        self.assertEqual(self.n("answer_vetoed"), 1)

    def test_it_shows_which_page_the_participant_reads(self):
        self.shows("  welcome  nothing tracked  ")
        self.until_a_sorting_trial_is_open()
        self.shows("  instructions  nothing tracked  ")
        self.shows("  trial  ")
        self.terminal.press("p")
        self.shows("  paused  nothing tracked  ")


DEMONSTRATION = """title = "Nothing but a demonstration"
display_rate_hz = 15
[[block]]
kind = "demonstration"
name = "demonstration"
duration_s = 1
"""


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool"), "needs Xvfb and xdotool")
class DemonstrationAlone(AtAConsole):
    """A session without a trial."""

    def setUp(self):
        super().setUp()
        self.protocol = self.folder / "demonstration.toml"
        self.protocol.write_text(DEMONSTRATION, encoding="utf-8")

    def wait_for_end(self):
        self.assertTrue(self.terminal.wait_for(lambda: self.terminal.program.poll() is not None))
        self.terminal.reader.join()
        self.assertEqual(self.terminal.program.returncode, 0, self.terminal.shown)
        self.assertEqual(query(self.db, "select state from session"), [("finished",)])

    def test_of_a_model_ends_well(self):
        self.start("--responder", "coin", protocol=self.protocol)
        self.wait_for_end()

    def test_the_last_page_can_not_be_paused_and_that_is_said(self):
        self.start(*self.HAND, protocol=self.protocol)

        def is_last_page():
            page = self.person.page()
            if page and page[1] != "thanks":
                time.sleep(1)  # the first moments of a page take no keys
                self.screen.key("Return")
                # If the first key only has a delay, a second one would turn the last page, too.
                self.terminal.wait_for(lambda: self.person.page() != page, 5)
            return page and page[1] == "thanks"
        self.assertTrue(self.terminal.wait_for(is_last_page), self.terminal.shown)
        self.terminal.press("p")
        self.shows("the session has ended; it cannot be paused")
        self.assertEqual(self.n("paused"), 0)
        self.person.take_part(30)
        self.wait_for_end()


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool"), "needs Xvfb and xdotool")
class OfAStudy(AtAConsole):
    def test_the_desk_has_the_participants_place_and_stays_blind(self):
        plan = self.folder / "STUDY.toml"
        plan.write_text(f"""study = "mass"
participants = 24
protocol = "{PROTOCOLS / 'quick.toml'}"
backup = "copies"
[order]
blocks = ["sorting", "comparison"]
[[group]]
name = "heavy ones"
[[group]]
name = "light ones"
""")
        self.start_as(["--plan", str(plan), "--participant", "07"], *self.HAND)
        self.shows("7 of 24  0:0")
        self.shows("welcome")
        self.assertNotIn("ones", self.terminal.shown)
        self.assertNotIn("sorting", self.terminal.shown)
        self.terminal.press("ey")
        self.shows("verified backup: ")
        self.terminal.program.wait()
        self.assertEqual(self.terminal.program.returncode, 130)
        copy, = (self.folder / "copies").iterdir()
        self.assertEqual(query(copy, "select value from participant_info where key = "
                                     "'study_place'"), [("7",)])


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool"), "needs Xvfb and xdotool")
class FailedCheck(AtAConsole):
    """A camera that films a gray wall."""

    def setUp(self):
        super().setUp()
        wall = self.folder / "wall"
        wall.mkdir()
        for i in range(3):
            (wall / f"{i}.pgm").write_bytes(b"P5 640 480 255\n" + bytes([128]) * 640 * 480)
        self.start("--tracker", f"frames:{wall}", "--camera-file",
                   str(PROTOCOLS / "apparatus" / "synthetic_camera.yaml"))
        self.shows("FAILED board")
        self.shows("  setting_up  ")
        self.shows("continue? y continues, n leaves, r checks again")
        self.assertEqual(self.n("text_shown", "and detail not like '%setting_up%'"), 0)

    def test_no_one_is_shown_anything_when_the_experimenter_leaves(self):
        self.terminal.press("xn")
        self.assertTrue(self.terminal.wait_for(lambda: self.terminal.program.poll() is not None))
        self.assertEqual(self.terminal.program.returncode, 130)
        self.terminal.reader.join()
        self.assertIn("heft resume", self.terminal.shown)
        self.assertEqual(query(self.db, "select state from session"), [("paused",)])
        self.assertEqual(self.n("text_shown", "and detail not like '%setting_up%'"), 0)
        self.assertEqual(self.n("note", "and detail like '%the experimenter leaves'"), 1)

    def test_the_session_begins_when_they_say_so(self):
        self.terminal.press("y")
        self.shows("  welcome  nothing tracked  ")
        self.assertEqual(self.n("note", "and detail like 'failed check: %board%; the experimenter "
                                        "continues'"), 1)


class Shell(Terminal):
    """A shell with job control at a terminal of so many columns, in which a program runs."""

    def __init__(self, environment, columns=80, rows=24):
        self.shown = ""
        child, self.keyboard = pty.fork()
        if child == 0:
            os.execvpe("bash", ["bash", "--norc", "--noprofile", "-i"],
                       dict(environment, NO_COLOR="1", PS1="$ ", TERM="xterm"))
        self.child = child
        self.resize(columns, rows)
        self.program = self
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def resize(self, columns, rows=24):
        fcntl.ioctl(self.keyboard, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def poll(self):
        return None

    def line_editing(self):
        """Whether the terminal edits lines and echoes, as a shell leaves it to programs."""
        flags = termios.tcgetattr(self.keyboard)[3]
        return bool(flags & termios.ICANON and flags & termios.ECHO)

    def close(self):
        os.kill(self.child, signal.SIGKILL)
        os.close(self.keyboard)
        os.waitpid(self.child, 0)


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool") and shutil.which("bash"),
                     "needs Xvfb, xdotool and bash")
class SmallTerminal(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.db = str(Path(folder.name) / "small.db")
        self.screen = Screen()
        self.addCleanup(self.screen.close)
        self.shell = Shell(self.screen.environment())
        self.addCleanup(self.shell.close)
        heft = os.path.abspath(HEFT)
        self.shell.press(f"'{heft}' run {PROTOCOLS / 'quick.toml'} --participant 07 --db {self.db} "
                         "--tracker hand --purpose test --seed 5\n")
        self.shows("u unblind")

    def shows(self, words, since=0):
        self.assertTrue(self.shell.wait_for(lambda: words in self.shell.shown[since:]),
                        self.shell.shown)

    def widest_drawn(self, since):
        """Length of the longest redrawn line."""
        drawn = re.findall(r"\r\x1b\[J([^\r\n]*)\r?\n([^\r\n]*?)\x1b\[A", self.shell.shown[since:])
        self.assertTrue(drawn, self.shell.shown[since:])
        return max(len(line) for lines in drawn for line in lines)

    def test_no_line_is_wider_than_the_terminal_whatever_is_typed(self):
        since = len(self.shell.shown)
        for keys in ("n" + "a long note " * 20, "\x1b", "v", "the door slammed and " * 8, "\x1b", "x",
                     "\x1b", "e", "n", "u", "n"):
            self.shell.press(keys)
            time.sleep(0.5)
        self.assertLess(self.widest_drawn(since), 80)
        self.shell.resize(50)
        time.sleep(1)
        since = len(self.shell.shown)
        time.sleep(1)
        self.assertLess(self.widest_drawn(since), 50)

    def test_a_stopped_program_gives_the_terminal_back_and_takes_it_again(self):
        self.assertFalse(self.shell.line_editing())
        self.shell.press("\x1a")  # Ctrl-Z
        self.shows("Stopped")
        since = len(self.shell.shown)
        self.shell.press("stty -a; echo here\n")
        self.shows("here", since)
        self.shell.wait_for(lambda: " icanon" in self.shell.shown[since:], 5)
        self.assertIn(" icanon", self.shell.shown[since:])
        since = len(self.shell.shown)
        self.shell.press("fg\n")
        self.shows("u unblind", since)
        self.assertTrue(self.shell.wait_for(lambda: not self.shell.line_editing(), 10))
        self.shell.press("nback again\n")
        self.assertTrue(self.shell.wait_for(
            lambda: query(self.db, "select detail from event where kind = 'note'") ==
            [("back again",)], 20), self.shell.shown[since:])
        self.shell.press("ey")
        self.shows("heft resume", since)
        self.assertTrue(self.shell.wait_for(lambda: "$ " in self.shell.shown[-200:], 10))


if __name__ == "__main__":
    unittest.main()

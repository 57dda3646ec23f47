"""A person's whole session in the window: a real X server, real clicks and keys, a real log.

Run: python3 tests/cli/window_test.py path/to/heft
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from session_harness import PROTOCOLS, query

HEFT = sys.argv.pop(1) if len(sys.argv) > 1 else "build/heft"
SIZE = (1024, 600)
# Middles of buttons on such a screen, right-handed.
BUTTONS = {"no_difference": (860, 245), "validate": (860, 445)}


class Screen:
    """An X server without a display, and hands on it."""

    def __init__(self, size=SIZE, pictures=None):
        """@param pictures: a folder for the picture, as Xvfb's -fbdir writes it"""
        read_end, write_end = os.pipe()
        # Without -noreset the server restarts after its last client and refuses new ones meanwhile.
        self.server = subprocess.Popen(
            ["Xvfb", "-noreset", "-displayfd", str(write_end),
             "-screen", "0", f"{size[0]}x{size[1]}x24",
             *(["-fbdir", str(pictures)] if pictures else [])],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as pipe:
            self.display = ":" + pipe.readline().strip()

    def environment(self):
        return dict(os.environ, DISPLAY=self.display, LIBGL_ALWAYS_SOFTWARE="1")

    def do(self, *command):
        subprocess.run(["xdotool", *map(str, command)], env=self.environment(), check=True,
                       capture_output=True, timeout=30)

    def key(self, name):
        self.do("key", name)

    def click(self, button):
        x, y = BUTTONS[button]
        self.do("mousemove", x, y, "click", 1)

    def close(self):
        self.server.terminate()
        self.server.wait()


class Person:
    """Does what the log says is on the screen."""

    def __init__(self, screen, db, program):
        self.screen, self.db, self.program = screen, db, program
        self.pages = []

    def log(self, sql):
        try:
            return query(self.db, sql)
        except Exception:  # not there yet
            return []

    def open_trial(self):
        rows = self.log("select trial_id, task, shown_s from trial where status = 'open'")
        return rows[0] if rows else None

    def page(self):
        rows = self.log("select event_id, json_extract(detail, '$.page') from event "
                        "where kind = 'text_shown' order by event_id desc limit 1")
        return rows[0] if rows else None

    def n_answers(self, trial_id):
        return self.log(f"select count(*) from answer where trial_id = {trial_id}")[0][0]

    def take_part(self, seconds):
        """For so many seconds, or until the program ends."""
        deadline = time.time() + seconds
        while self.program.poll() is None and time.time() < deadline:
            page = self.page()
            trial = self.open_trial()
            if page and page not in self.pages:
                self.pages.append(page)
            if trial and trial[2] is not None:
                self.answer(*trial[:2])
            elif page and not page[1].startswith("trial") and not trial:
                time.sleep(0.3)  # the first moments of a page take no taps
                self.screen.key("Return")
            time.sleep(0.1)

    def answer(self, trial_id, task):
        if task == "introduction":
            self.screen.key(1 + self.n_answers(trial_id) % 2)
        elif task == "comparison":
            self.screen.click("no_difference")
        elif task == "adjustment":  # up to three steps, one of each button in turn
            n = self.n_answers(trial_id)
            self.screen.key(1 + (trial_id + n) % 4 if n < trial_id % 4 else "Return")
        else:
            given = dict(self.log(f"select slot, label from answer where trial_id = {trial_id} "
                                  "and action = 'label' order by answer_id"))
            for cube, label in ((1, "lightest"), (2, "intermediate"), (3, "heaviest")):
                if given.get(cube) != label:  # the first moments of a page take no keys
                    self.screen.key(cube)
                    self.screen.key(label[0])
            self.screen.click("validate")


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool"), "needs Xvfb and xdotool")
class Window(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.db = str(Path(self.folder.name) / "window.db")
        self.screen = Screen()
        self.program = None

    def tearDown(self):
        if self.program and self.program.poll() is None:
            self.program.kill()
            self.program.wait()
        self.screen.close()
        self.folder.cleanup()

    def start(self, *options, protocol=PROTOCOLS / "quick.toml"):
        """On a busy machine, too, which may fail the check of the picture rate."""
        command = [HEFT, "run", str(protocol), "--participant", "07", "--db", self.db,
                   "--seed", "5", "--purpose", "test", "--ignore-failed-checks", *options]
        # A process group that has no parent in its session cannot be suspended.
        self.program = subprocess.Popen(command, env=self.screen.environment(), text=True,
                                        stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, process_group=0)
        return Person(self.screen, self.db, self.program)

    def finish(self):
        _, talk = self.program.communicate(timeout=60)
        self.assertEqual(self.program.returncode, 0, talk)

    def test_a_whole_session_by_touch_and_keys(self):
        person = self.start("--tracker", "hand")
        person.take_part(240)
        self.finish()
        self.assertEqual(query(self.db, "select state, purpose, responder from session"),
                         [("finished", "test", "human")])
        pages = [page for _, page in person.pages]
        for page in ("welcome", "instructions_sorting", "instructions_comparison"):
            self.assertIn(page, pages)
        self.assertEqual(query(self.db, "select count(*) from trial where status = 'completed' "
                                        "and task = 'sorting'"), [(2,)])
        self.assertEqual(query(self.db, "select count(*) from trial where outcome = "
                                        "'no_difference' and task = 'comparison'")[0][0] > 3, True)
        late = query(self.db, "select count(*) from frame where present_s < simulated_s or "
                              "simulated_s < detected_s or detected_s < capture_s")
        self.assertEqual(late, [(0,)])
        replay = subprocess.run([HEFT, "replay", "--db", self.db], capture_output=True, text=True)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)

    def test_fifty_adjustments_are_set_by_keys(self):
        protocol = Path(self.folder.name) / "adjust.toml"
        protocol.write_text(
            'title = "Adjustments"\ndisplay_rate_hz = 15\n[screens]\nlanguage = "fr"\n'
            'consent = false\nabout_you = false\n[[block]]\nkind = "adjustment"\n'
            'name = "adjustment"\nreference_g = [100, 200]\nstart_g = [100, 400]\n'
            'steps_g = [50, 10]\ntrials = 25\ncondition = "C2"\n')
        person = self.start("--tracker", "hand", protocol=protocol)
        person.take_part(400)
        self.finish()
        rows = query(self.db, "select t.reference_g + t.level_g, t.value, t.n_reshuffles, "
                              "(select count(*) from answer a where a.trial_id = t.trial_id and "
                              "a.action = 'adjust'), (select coalesce(sum(a.value), 0) from answer "
                              "a where a.trial_id = t.trial_id and a.action = 'adjust'), "
                              "(select mass_g from cube c where c.trial_id = t.trial_id and "
                              "c.slot <> t.reference_slot) from trial t where status = 'completed'")
        self.assertEqual(len(rows), 50)
        for start_g, value_g, n_replaced, n_steps, steps_g, shown_g in rows:
            self.assertAlmostEqual(start_g + steps_g, value_g, places=9)
            self.assertEqual(value_g, shown_g)
            self.assertEqual(n_replaced, n_steps)
        self.assertGreater(sum(row[3] for row in rows), 50)
        replay = subprocess.run([HEFT, "replay", "--db", self.db], capture_output=True, text=True)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)

    def test_a_program_that_is_stopped_pauses_the_trial(self):
        person = self.start("--responder", "simulated", "--view", "window")
        for stop, why in ((signal.SIGSTOP, "the program stood still"), (signal.SIGTSTP, "suspended")):
            shown = "select trial_id from trial where status = 'open' and shown_s is not null"
            self.wait_for(lambda: person.log(shown))
            [(trial,)] = person.log(shown)
            time.sleep(0.5)
            self.program.send_signal(stop)
            stat = Path(f"/proc/{self.program.pid}/stat")
            self.wait_for(lambda: stat.read_text().rsplit(")", 1)[1].split()[0] == "T")
            time.sleep(1)
            self.program.send_signal(signal.SIGCONT)
            self.wait_for(lambda: person.log(
                f"select 1 from trial where trial_id = {trial} and status = 'completed'"))
            [(paused_s,)] = person.log(f"select paused_s from trial where trial_id = {trial}")
            self.assertGreater(paused_s, 0.95)
            self.assertEqual(person.log("select detail from event where kind = 'paused' and "
                                        f"trial_id = {trial}"), [(why,)])
        self.program.send_signal(signal.SIGINT)
        self.program.communicate(timeout=60)
        replay = subprocess.run([HEFT, "replay", "--db", self.db], capture_output=True, text=True)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)

    def wait_for(self, condition, seconds=60):
        deadline = time.time() + seconds
        while not condition():
            self.assertLess(time.time(), deadline)
            self.assertIsNone(self.program.poll())
            time.sleep(0.02)

    def test_a_filmed_hand_is_tracked_under_the_participants_answers(self):
        person = self.start("--tracker", "synthetic", "--language", "fr")
        deadline = time.time() + 120
        while person.program.poll() is None and time.time() < deadline:
            person.take_part(2)
            if person.log("select trial_id from trial where status = 'completed'"):
                break
        self.program.terminate()
        self.program.wait(timeout=60)
        languages = query(self.db, "select distinct json_extract(detail, '$.language') from event "
                                   "where kind = 'text_shown'")
        self.assertEqual(languages, [("fr",)])
        self.assertGreater(query(self.db, "select avg(tracked) from frame")[0][0], 0.9)
        checks = dict(query(self.db, "select json_extract(detail, '$.name'), json_extract(detail, "
                                     "'$.verdict') from event where kind = 'check'"))
        self.assertEqual({name: checks[name] for name in ("board", "light", "print scale")},
                         {"board": "ok", "light": "ok", "print scale": "warning"})
        replay = subprocess.run([HEFT, "replay", "--db", self.db], capture_output=True, text=True)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)

    def test_a_window_that_is_made_smaller_is_noted(self):
        person = self.start("--tracker", "hand", "--display", "0")
        notes = "select detail from event where kind = 'note' order by event_id"
        deadline = time.time() + 60
        while (person.page() or ["", "setting_up"])[1] == "setting_up" and time.time() < deadline:
            time.sleep(0.1)
        for messages in (["the window is no longer full screen"],
                         ["the window is no longer full screen", "the window is now full screen"]):
            time.sleep(0.5)
            self.screen.key("F11")
            while [text for text, in person.log(notes)] != messages and time.time() < deadline:
                time.sleep(0.1)
            self.assertEqual([text for text, in person.log(notes)], messages)
        self.program.terminate()
        self.program.wait(timeout=60)

    def drag(self, start, end):
        """With the mouse, in steps as a hand would."""
        steps = 12
        self.screen.do("mousemove", *start, "mousedown", 1)
        for i in range(1, steps + 1):
            self.screen.do("mousemove", *(a + (b - a) * i // steps for a, b in zip(start, end)))
            time.sleep(0.03)
        self.screen.do("mouseup", 1)
        time.sleep(0.3)

    def wait_for_cubes(self, person):
        deadline = time.time() + 60
        while not (person.open_trial() or (0, "", None))[2]:
            self.assertLess(time.time(), deadline)
            if self.program.poll() is not None:
                self.fail(self.program.communicate()[1])
            if person.page() and not person.open_trial():
                self.screen.key("Return")
            time.sleep(0.4)

    def test_a_newcomer_without_a_printer_pushes_a_cube_with_the_mouse(self):
        person = self.start("--tracker", "mouse")
        self.wait_for_cubes(person)
        self.drag((355, 470), (277, 470))
        self.drag((277, 470), (277, 280))
        self.screen.do("click", "--repeat", 3, 4)
        deadline = time.time() + 60
        while not person.log("select 1 from cube where n_pushes > 0 and slot = 1"):
            self.assertLess(time.time(), deadline, "no cube was pushed")
            time.sleep(0.3)
        self.program.terminate()
        self.program.communicate(timeout=60)
        moved = query(self.db, "select max(effector_y_m) - min(effector_y_m), max(tracked), "
                               "max(abs(effector_qw - 0.7071)) from frame")
        self.assertGreater(moved[0][0], 0.05)
        self.assertEqual(moved[0][1], 1)
        self.assertGreater(moved[0][2], 0.05, "the wheel turned it")
        self.assertEqual(query(self.db, "select tracker, responder from setup"),
                         [("mouse", "human")])
        self.assertEqual(query(self.db, "select json_extract(detail, '$.name') from event "
                                        "where kind = 'check'"), [("picture rate",)])
        replay = subprocess.run([HEFT, "replay", "--db", self.db], capture_output=True, text=True)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)
        analysed = subprocess.run([HEFT, "analyse", "--db", self.db], capture_output=True, text=True)
        self.assertIn("dragged on the screen", analysed.stdout + analysed.stderr)

    def test_the_display_is_in_the_setup_and_the_clones_offset_in_degrees(self):
        measured = Path(self.folder.name) / "display.toml"
        calibrate = subprocess.Popen(
            [HEFT, "calibrate", "display", "--eye-distance-mm", "450", "--out", str(measured)],
            env=self.screen.environment(), text=True, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.program = calibrate
        while calibrate.poll() is None:
            for _ in range(3):  # the window may not be there yet; then half a card's 570 px
                time.sleep(1)
                self.screen.do("mousemove", 700, 300, "mousedown", 1, "mousemove", 797, 300,
                               "mouseup", 1)
            self.screen.key("Return")
            time.sleep(1)
        printed, talk = calibrate.communicate(timeout=60)
        self.assertEqual(calibrate.returncode, 0, talk)
        self.assertRegex(printed, r"^1024 x 600 pixels are 153\.[0-9] x 90\.[0-9] mm, seen from 450 mm")
        person = self.start("--tracker", "synthetic", "--display-file", str(measured), "--windowed",
                            "--hand", "left", "--controls", "left")
        self.wait_for_cubes(person)
        offsets = "select count(clone_offset_px), max(clone_offset_deg) from v_frame"
        deadline = time.time() + 60
        while time.time() < deadline and query(self.db, offsets)[0][0] <= 5:
            time.sleep(1)
        self.program.terminate()
        self.program.communicate(timeout=60)
        setup = query(self.db, "select display like '0 %', display_w_px, display_h_px, "
                               "round(display_w_mm), eye_distance_mm, display_scale, window, hand, "
                               "controls from setup")
        self.assertEqual(setup, [(1, 1024, 600, 154.0, 450.0, 1.0, "window", "left", "left")])
        pages = query(self.db, "select json_extract(detail, '$.page') from event "
                               "where kind = 'text_shown' order by event_id")
        self.assertEqual(pages[0], ("setting_up",))
        seen, largest_deg = query(self.db, offsets)[0]
        self.assertGreater(seen, 5)
        self.assertTrue(0 <= largest_deg < 15, largest_deg)
        replay = subprocess.run([HEFT, "replay", "--db", self.db], capture_output=True, text=True)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)

    def test_another_display_than_the_measured_one_or_none_of_that_number_is_refused(self):
        measured = Path(self.folder.name) / "display.toml"
        subprocess.run([HEFT, "calibrate", "display", "--width-mm", "154", "--height-mm", "90",
                        "--eye-distance-mm", "450", "--out", str(measured)], check=True,
                       env=self.screen.environment(), capture_output=True, timeout=60)
        text = measured.read_text(encoding="utf-8")
        measured.write_text(text.replace("width_px = 1024", "width_px = 1920"), encoding="utf-8")
        for code, options, why in ((3, ["--display-file", str(measured)], "heft calibrate display"),
                                   (4, ["--display", "3"], "no display 3"),
                                   (2, ["--display", "left"], "heft doctor")):
            run = subprocess.run([HEFT, "run", str(PROTOCOLS / "quick.toml"), "--participant", "07",
                                  "--db", self.db, "--tracker", "hand", *options],
                                 env=self.screen.environment(), text=True, capture_output=True,
                                 timeout=60)
            self.assertEqual(run.returncode, code, run.stderr)
            self.assertIn(why, run.stderr)
            self.assertFalse(Path(self.db).exists())

    def test_doctor_reports_on_display_graphics_typeface_and_touch(self):
        run = subprocess.run([HEFT, "doctor", "--db", self.db], env=self.screen.environment(),
                             text=True, capture_output=True, timeout=120)
        for line in (r"ok       display +0 \(.*\), 1024 x 600 pixels", r"graphics +\S",
                     r"ok       typeface", r"ok       touch",
                     r"(ok|warning) +touch delay +\d+\.\d ms from the touch's event.*of (4\d|50):",
                     r"(ok|warning|FAILED) +picture rate +a picture each \d+\.\d ms, \d+ ms after "
                     r"its capture \(99 %: \d+ ms\), \d+ of \d+ dropped"):
            self.assertRegex(run.stdout, line)
        nothing = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        run = subprocess.run([HEFT, "doctor", "--db", self.db], env=nothing, text=True,
                             capture_output=True, timeout=120)
        self.assertRegex(run.stdout, r"ok +touch delay +not measured: there is no display")

    def test_without_a_display_nothing_is_begun(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        run = subprocess.run([HEFT, "run", str(PROTOCOLS / "quick.toml"), "--participant", "07",
                              "--db", self.db, "--tracker", "hand"], env=environment, text=True,
                             capture_output=True, timeout=60)
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertFalse(Path(self.db).exists())

    def test_who_declines_ends_the_session_and_that_is_no_error(self):
        text = (PROTOCOLS / "quick.toml").read_text(encoding="utf-8")
        self.assertNotIn("[screens]", text)
        protocol = Path(self.folder.name) / "asking.toml"
        protocol.write_text(text + "\n[screens]\nconsent = true\n", encoding="utf-8")
        person = self.start("--tracker", "hand", protocol=protocol)
        deadline = time.time() + 60
        while person.program.poll() is None and time.time() < deadline:
            if person.page():
                self.screen.key("n")  # and once more on the page that asks whether they are sure
            time.sleep(0.5)
        _, talk = person.program.communicate(timeout=60)
        self.assertEqual(person.program.returncode, 0, talk)
        self.assertIn("declined", talk)
        self.assertEqual(query(self.db, "select state from session"), [("aborted",)])
        self.assertEqual(query(self.db, "select json_extract(detail, '$.agreed') from event where "
                                        "kind = 'consent'"), [(0,)])
        self.assertEqual(query(self.db, "select count(*) from trial"), [(0,)])

    def test_people_get_no_simulator_that_knows_one_stroke_only(self):
        run = subprocess.run([HEFT, "run", str(PROTOCOLS / "quick.toml"), "--participant", "07",
                              "--db", self.db, "--tracker", "hand", "--simulator", "push"],
                             env=self.screen.environment(), text=True, capture_output=True,
                             timeout=60)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertFalse(Path(self.db).exists())

    def test_without_a_camera_nothing_is_begun(self):
        run = subprocess.run([HEFT, "run", str(PROTOCOLS / "quick.toml"), "--participant", "07",
                              "--db", self.db, "--tracker", "camera:63"],
                             env=self.screen.environment(), text=True, capture_output=True,
                             timeout=60)
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertIn("camera", run.stderr)
        self.assertFalse(Path(self.db).exists())


if __name__ == "__main__":
    unittest.main()

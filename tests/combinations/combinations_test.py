"""Every allowed combination of responder, tracker, view and simulator runs, resumes and replays as
verified; others are refused with a reason before anything is logged. Live cameras: tests/session.

Run: python3 tests/combinations/combinations_test.py path/to/heft [seed]
"""
import concurrent.futures
import itertools
import json
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests" / "cli"))
HEFT = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else str(ROOT / "build" / "heft")
SEED = int(sys.argv.pop(1)) if len(sys.argv) > 1 else random.SystemRandom().randrange(10**9)
sys.argv.insert(1, HEFT)  # window_test takes it, too

from protocols import ALL, N_ALL, ONE, PAIRS, TWO, protocol, write_recording  # noqa: E402
from session_harness import query  # noqa: E402
from window_test import Person, Screen  # noqa: E402

GOLDEN_LOGS = ROOT / "tests" / "golden" / "logs"
CAMERA = ROOT / "protocols" / "apparatus" / "synthetic_camera.yaml"
RESTING = ["always_yes", "always_no", "coin", "criterion_only", "start_anchored", "weber"]
FILMED = ["synthetic", "frames", "video"]
HAS_SCREEN = shutil.which("Xvfb") and shutil.which("xdotool")
AT_ONCE = 6  # processes; most of them wait


class Answerer(Person):
    """Gives the answer that needs no cube to be pushed."""

    def answer(self, trial_id, task):
        self.screen.key("d" if task == "sorting" else "n")


class Combinations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        print(f"seed {SEED}", flush=True)
        cls.temporary = tempfile.TemporaryDirectory(prefix="heft-combinations-")
        cls.folder = Path(cls.temporary.name)
        cls.screen = Screen() if HAS_SCREEN else None
        for name, text in (("one", ONE), ("two", TWO), ("all", ALL),
                           ("fast", protocol(PAIRS, display_rate_hz=30, contact=False))):
            (cls.folder / f"{name}.toml").write_text(text, encoding="utf-8")
        write_recording(cls.folder / "script", N_ALL)
        write_recording(cls.folder / "half", 1)
        # Filmed at twice the rate that sessions here display; the film has the cubes in it.
        cls.heft("run", cls.folder / "fast.toml", "--participant", "filmed", "--responder",
                 "simulated", "--tracker", "synthetic", "--record-camera", cls.folder / "frames",
                 "--view", f"video:{cls.folder / 'film.avi'}", "--db", cls.folder / "filmed.db",
                 "--seed", 1)

    @classmethod
    def tearDownClass(cls):
        if cls.screen:
            cls.screen.close()
        cls.temporary.cleanup()

    @classmethod
    def environment(cls):
        return cls.screen.environment() if cls.screen else dict(os.environ)

    @classmethod
    def heft(cls, *words, expect=0, environment=None, cwd=None):
        done = subprocess.run([HEFT, *map(str, words)], capture_output=True, text=True, timeout=120,
                              env=environment or cls.environment(), cwd=cwd or cls.folder,
                              stdin=subprocess.DEVNULL)
        if expect is not None and done.returncode != expect:
            raise AssertionError(f"{words}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done

    def options(self, name, tracker, view):
        """Options of the command line for a tracker and a view."""
        of_tracker = {"hand": ["hand"], "synthetic": ["synthetic"], "mouse": ["mouse"],
                      "frames": [f"frames:{self.folder / 'frames'}", "--camera-file", CAMERA],
                      "video": [f"video:{self.folder / 'film.avi'}", "--camera-file", CAMERA]}
        file = f":{self.folder / name}.avi" if view == "video" else ""
        return ["--tracker", *of_tracker[tracker], "--view", view + file]

    def responder(self, name, recording="script"):
        return f"scripted:{self.folder / recording}" if name == "scripted" else name

    def each(self, check, cases):
        """Checks all cases, several in parallel; every failure is reported with its case."""
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            running = [(case, pool.submit(check, *case)) for case in cases]
        for case, done in running:
            with self.subTest(case=case, seed=SEED):
                done.result()

    def verified(self, db, unfinished=False):
        said = self.heft("replay", "--db", db).stdout
        self.assertIn("verified up to event" if unfinished else "verified:", said)
        self.assertEqual("unfinished" in said, unfinished, said)

    def said_to_be_simulated(self, db):
        said = json.loads(self.heft("analyse", "--db", db, "--mix", "--json").stdout)
        self.assertIs(said["simulated"], True)

    def asked_once(self, db):
        """The questionnaire was shown exactly once."""
        self.assertEqual(query(db, "select count(*) from participant_info where key = "
                                   "'fours.borg_cr10.done_s'"), [(1,)])

    def new(self, *parts):
        return self.folder / ("-".join(parts) + ".db")

    # Allowed combinations

    def meet(self, responder, tracker, view):
        db = self.new("fresh", responder, tracker, view)
        which = "all" if tracker == "hand" and view != "window" else "one"
        done = self.heft("run", self.folder / f"{which}.toml", "--participant", "1", "--responder",
                         self.responder(responder), "--db", db, "--seed", SEED,
                         *self.options(db.stem, tracker, view), expect=None)
        # A filmed hand is not the model's: it may not touch the cubes that the model waits for.
        ended = responder == "simulated" and tracker in ("frames", "video") and done.returncode == 1
        self.assertTrue(done.returncode == 0 or ended, done.stderr)
        self.verified(db, unfinished=ended)
        self.assertEqual(query(db, "select responder like ? || '%', tracker like ? || '%', "
                               "view like ? || '%' from setup".replace("?", "'{}'").format(
                                   responder, tracker, view)), [(1, 1, 1)])
        self.check_pace(db, tracker, view)
        if which == "all":
            self.asked_once(db)
        if not ended:
            self.assertEqual(query(db, "select count(*) from trial where status = 'completed'"),
                             [(N_ALL if which == "all" else 1,)])
            self.said_to_be_simulated(db)

    def check_pace(self, db, tracker, view):
        filmed = tracker in ("frames", "video")
        said = query(db, "select source_rate_hz, display_rate_hz from setup")[0]
        self.assertEqual(said[1], 15)
        self.assertEqual(round(said[0] or 0), 30 if filmed else 0)
        steps = query(db, "select trial_t_s - lag(trial_t_s) over (partition by trial_id order by "
                      "frame_id) from frame")
        steps = sorted(step for step, in steps if step is not None)
        if view != "window":  # without a window no frame is late
            self.assertAlmostEqual(steps[0], 1 / 15, delta=2e-3)
            self.assertAlmostEqual(steps[-1], 1 / 15, delta=2e-3)
        self.assertGreater(steps[len(steps) // 2], 1 / 15 - 2e-3)

    def test_models_trackers_and_views(self):
        views = ["headless", "video"] + (["window"] if self.screen else [])
        cases = list(itertools.product(["simulated", "scripted", *RESTING], ["hand"], views))
        cases += itertools.product(["coin"], FILMED, views)
        cases += itertools.product(["simulated", "scripted"], FILMED, ["headless", "video"])
        # The others differ from "coin" in one number: each with one of the films, drawn by the seed.
        drawn = random.Random(SEED)
        cases += [(name, drawn.choice(FILMED), "headless") for name in RESTING if name != "coin"]
        if self.screen:  # one of the others with each film
            others = ["simulated", "scripted", *(name for name in RESTING if name != "coin")]
            cases += [(drawn.choice(others), tracker, "window") for tracker in FILMED]
        cases.sort(key=lambda case: case[2] != "window")  # the slow ones first
        self.each(self.meet, cases)

    # Sessions that are resumed

    def interrupted(self, name, which="all"):
        """A log whose session ended in its second trial."""
        db = self.new("resumed", name)
        self.heft("run", self.folder / f"{which}.toml", "--participant", "1", "--responder",
                  self.responder("scripted", "half"), "--db", db, "--seed", SEED, "--backup",
                  self.folder / f"copies-{name}", expect=1)
        self.assertEqual(len(list((self.folder / f"copies-{name}").glob("*.db"))), 1)
        self.verified(db, unfinished=True)
        return db

    def follow(self, name, responder, *options):
        filmed = name in ("on frames", "on video")  # the film is of one trial
        db = self.interrupted(name, "two" if filmed else "all")
        self.heft("resume", "--db", db, "--responder", self.responder(responder), *options)
        self.verified(db)
        setups = query(db, "select setup_id, responder, simulator from setup order by setup_id")
        self.assertEqual(len(setups), 2)
        self.assertEqual(query(db, "select distinct setup_id from trial where trial_number > 1 and "
                               "status = 'completed'"), [setups[1][:1]])
        self.assertEqual(query(db, "select setup_id from trial where trial_number = 1"),
                         [setups[0][:1]])
        self.assertIn(responder, setups[1][1])
        if not filmed:
            self.asked_once(db)
        self.said_to_be_simulated(db)

    def test_sessions_that_continue_with_something_else(self):
        cases = [(name, name) for name in ["scripted", "simulated", *RESTING]]
        cases += [(f"on {tracker}", "coin", *self.options(f"on {tracker}", tracker, "headless"))
                  for tracker in FILMED]
        cases += [("bullet", "simulated", "--simulator", "bullet-ea"),
                  ("auto", "simulated", "--simulator", "auto"),
                  ("film", "coin", *self.options("film-again", "hand", "video"))]
        if self.screen:
            cases.append(("window", "coin", "--view", "window"))
        self.each(self.follow, cases)

    # Older and changed logs

    def test_an_older_log_continues_with_another_simulator(self):
        for simulator in ("", "bullet-ea", "boxes"):  # "": the simulator of the log
            with self.subTest(simulator=simulator):
                db = shutil.copy(GOLDEN_LOGS / "version_5_unfinished.db",
                                 self.folder / f"old-{simulator}.db")
                self.heft("resume", "--db", db, "--tracker", "hand",
                          *(["--simulator", simulator] if simulator else []))
                self.verified(db)
                resumed, = query(db, "select simulator from setup order by setup_id desc limit 1")
                self.assertEqual(resumed[0], simulator or "boxes")

    def test_a_log_of_version_6_is_resumed_with_its_configuration(self):
        db = shutil.copy(GOLDEN_LOGS / "version_6.db", self.folder / "version_6.db")
        self.heft("resume", "--db", db, "--tracker", "hand")
        self.verified(db)
        setups = query(db, "select controls, simulator, simulator_reason from setup where "
                           "session_id = 2")
        self.assertEqual(setups[0], setups[-1])
        self.assertEqual(setups[0][0], "left")

    def test_a_log_that_a_session_was_taken_out_of_says_so(self):
        db = self.folder / "three.db"
        for participant in "123":
            self.heft("run", self.folder / "one.toml", "--participant", participant, "--responder",
                      "always_no", "--db", db)
        self.verified(db)
        log = sqlite3.connect(db)
        tables = [name for name, in log.execute("select name from sqlite_master where type = 'table'")]
        columns = {table: [row[1] for row in log.execute(f"pragma table_info({table})")]
                   for table in tables}
        for table in sorted(tables, key=lambda name: "session_id" in columns[name]):
            if "session_id" in columns[table]:
                log.execute(f"delete from {table} where session_id = 2")
            elif "trial_id" in columns[table]:
                log.execute(f"delete from {table} where trial_id in "
                            "(select trial_id from trial where session_id = 2)")
        log.commit()
        log.close()
        said = self.heft("replay", "--db", db, expect=5).stdout
        self.assertIn("sessions between 1 and 3", said)

    def test_a_simulator_of_the_studies_alone_is_verified_too(self):
        db = self.folder / "studies.db"
        self.heft("run", self.folder / "one.toml", "--participant", "1", "--responder", "simulated",
                  "--simulator", "bullet-stable-pd", "--db", db)
        self.verified(db)

    def test_a_simulator_of_the_studies_after_another_session_is_reported_once(self):
        db = self.folder / "mixed.db"
        for simulator in ("boxes", "bullet-stable-pd"):
            self.heft("run", self.folder / "one.toml", "--participant", simulator, "--responder",
                      "simulated", "--simulator", simulator, "--db", db)
        said = self.heft("replay", "--db", db).stdout
        self.assertEqual(said.count("sessions 1 to 2: verified"), 1, said)

    # People

    def answered(self, db, *command):
        screen = Screen()
        try:
            program = subprocess.Popen([HEFT, *map(str, command)], env=screen.environment(),
                                       cwd=self.folder, text=True, stdin=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE)
            Answerer(screen, str(db), program).take_part(50)
            if program.poll() is None:
                program.kill()
            said = program.communicate()[1]
            self.assertEqual(program.returncode, 0, said)
        finally:
            screen.close()

    def person(self, tracker):
        db = self.new("person", tracker)
        self.answered(db, "run", self.folder / "one.toml", "--participant", "1", "--purpose",
                      "test", "--ignore-failed-checks", "--db", db, "--seed", SEED, *self.options("", tracker, "window"))
        self.verified(db)
        said = json.loads(self.heft("analyse", "--db", db, "--json").stdout)
        self.assertIs(said["simulated"], False)

    def person_after_model(self):
        db = self.interrupted("person")
        self.answered(db, "resume", "--db", db, "--responder", "human", "--view", "window",
                      "--keys")
        self.verified(db)
        self.asked_once(db)
        self.said_to_be_simulated(db)

    @unittest.skipUnless(HAS_SCREEN, "needs Xvfb and xdotool")
    def test_people(self):
        with concurrent.futures.ThreadPoolExecutor() as pool:
            running = [pool.submit(self.person, tracker) for tracker in ("hand", "synthetic", "mouse")]
            running.append(pool.submit(self.person_after_model))
        for done in running:
            done.result()

    def test_every_kind_of_technique_is_simulated_and_replayed(self):
        db = self.new("techniques")
        self.heft("simulate", self.folder / "all.toml", "--responder", "simulated",
                  "--participants", "1", "--db", db, "--seed", SEED, "--frames")
        conditions = {row[0] for row in query(db, "select distinct condition from trial")}
        self.assertEqual(conditions, {"C1", "soft", "ratio", "slow"})
        self.verified(db)
        self.heft("replay", "--db", db, "--set", "technique.ratio.gain_of_mass=[[15, 0.5]]")
        self.heft("replay", "--db", db, "--set", "technique.ratio.gain_of_mass=[[0, 1]]", expect=3)

    # Replays without the session's files

    def replay_otherwise(self, tracker, view):
        db = self.new("otherwise", tracker, view)
        copy = self.folder / f"moved-{tracker}-{view}"
        if tracker == "frames":
            shutil.copytree(self.folder / "frames", copy)
        options = [str(word).replace(str(self.folder / "frames"), str(copy))
                   for word in self.options(db.stem, tracker, view)]
        self.heft("run", self.folder / "one.toml", "--participant", "1", "--responder", "coin",
                  "--db", db, "--seed", SEED, *options)
        shutil.rmtree(copy, ignore_errors=True)
        (self.folder / f"{db.stem}.avi").unlink(missing_ok=True)
        nothing = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for changes in ([], ["--simulator", "bullet-ea"], ["--set", "physics.friction=0.6"]):
            self.heft("replay", "--db", db, *changes, environment=nothing)
        self.assertFalse((self.folder / f"{db.stem}.avi").exists())
        self.heft("replay", "--db", db, "--responder", "always_no", environment=nothing)

    def test_replays_need_nothing_but_the_log(self):
        cases = [("hand", "headless"), ("synthetic", "headless"), ("frames", "headless"),
                 ("hand", "video")] + ([("hand", "window")] if self.screen else [])
        self.each(self.replay_otherwise, cases)

    # Refused combinations

    REFUSED = [
        (2, ["--responder", "human", "--tracker", "hand", "--view", "headless"], "window"),
        (2, ["--responder", "human", "--tracker", "hand", "--view", "video:FOLDER/new.avi"],
         "window"),
        (2, ["--responder", "human", "--view", "window", "--tracker", "hand", "--simulator",
             "push"], "straight pushes"),
        (2, ["--responder", "simulated", "--simulator", "push"], "straight pushes"),
        (2, ["--responder", "simulated", "--tracker", "synthetic", "--simulator", "quasi_static"],
         "straight pushes"),
        (2, ["--responder", "coin", "--tracker", "mouse", "--view", "window"], "moves it without a mouse"),
        (2, ["--responder", "human", "--tracker", "mouse", "--view", "headless"], "window"),
        (2, ["--responder", "human", "--tracker", "mouse:FOLDER/frames"], "takes no argument"),
        (2, ["--responder", "nobody"], "nobody"),
        (2, ["--responder", "scripted"], "folder"),
        (1, ["--responder", "scripted:FOLDER/none"], "none"),
        (2, ["--responder", "always_yes:FOLDER/one.toml"], "file"),
        (3, ["--responder", "coin:FOLDER/one.toml"], "one.toml"),
        (1, ["--responder", "coin:FOLDER/none.toml"], "none.toml"),
        (2, ["--responder", "coin", "--tracker", "nothing"], "tracker"),
        (2, ["--responder", "coin", "--tracker", "camera"], "needs a source"),
        (4, ["--responder", "coin", "--tracker", "camera:63", "--camera-file", CAMERA], "63"),
        (2, ["--responder", "coin", "--tracker", "frames:FOLDER/frames"], "--camera-file"),
        (1, ["--responder", "coin", "--tracker", "frames:FOLDER/none", "--camera-file", CAMERA],
         "none"),
        (1, ["--responder", "coin", "--tracker", "video:FOLDER/one.toml", "--camera-file", CAMERA],
         "video"),
        (2, ["--responder", "coin", "--tracker", "hand:FOLDER/frames"], "takes no argument"),
        (2, ["--responder", "coin", "--record-camera", "FOLDER/kept"], "camera"),
        (2, ["--responder", "coin", "--view", "video"], "file"),
        (2, ["--responder", "coin", "--view", "headless:FOLDER/one.toml"], "takes no argument"),
        (2, ["--responder", "coin", "--view", "windows"], "window"),
        (4, ["--responder", "coin", "--view", "window"], "display"),
        (2, ["--responder", "coin", "--simulator", "nothing"], "simulator"),
        *((2, ["--responder", name, "--set", "require_contact=true", "--tracker", tracker],
           f'"{name}" never touches a cube') for name in RESTING for tracker in ("hand", "synthetic")),
    ]

    def refuse(self, number, code, options, reason):
        folder = self.folder / f"refused-{number}"
        folder.mkdir()
        words = [str(word).replace("FOLDER", str(self.folder)) for word in options]
        nothing = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        before = sorted(self.folder.glob("*"))
        for attempt in range(2):  # without a log, and with one, which remains unchanged
            done = self.heft("run", self.folder / "one.toml", "--participant", "1", "--db", "a.db",
                             *words, expect=code, environment=nothing, cwd=folder)
            self.assertIn(reason, done.stderr)
            if attempt == 0:
                self.assertEqual(list(folder.iterdir()), [])
                self.heft("run", self.folder / "one.toml", "--participant", "2", "--responder",
                          "coin", "--db", "a.db", cwd=folder)
        self.assertEqual(query(folder / "a.db", "select participant from session"), [("2",)])
        self.assertEqual(sorted(self.folder.glob("*")), before)

    def test_what_may_not_meet_is_refused_before_anything_is_logged(self):
        for number, case in enumerate(self.REFUSED):
            with self.subTest(case=case):
                self.refuse(number, *case)

    def test_a_hand_that_rests_is_refused_where_answers_need_contact(self):
        contact = ["--set", "require_contact=true"]
        done = self.heft("simulate", self.folder / "one.toml", "--responder", "coin",
                         "--participants", "1", "--db", "none.db", *contact, expect=2)
        self.assertIn('block "pairs"', done.stderr)
        self.assertFalse((self.folder / "none.db").exists())
        db = self.new("contact")
        touch = self.folder / "touch.toml"
        touch.write_text(TWO.replace("require_contact = false", "require_contact = true"))
        self.heft("run", touch, "--participant", "1", "--responder",
                  self.responder("scripted", "half"), "--db", db, expect=1)
        rows = ["select count(*), max(event_id) from event", "select count(*) from setup"]
        before = [query(db, sql) for sql in rows]
        for words in (["resume", "--db", db, "--responder", "coin"],
                      ["replay", "--db", db, "--responder", "coin", "--rerun"]):
            self.assertIn('"coin" never touches a cube', self.heft(*words, expect=2).stderr)
            self.assertEqual([query(db, sql) for sql in rows], before)
        self.heft("resume", "--db", db, "--responder", "simulated")
        self.verified(db)

    def test_what_may_not_follow_leaves_the_log_as_it_is(self):
        db = self.interrupted("refused")
        rows = ["select count(*), max(event_id) from event", "select count(*) from setup",
                "select state from session"]
        before = [query(db, sql) for sql in rows]
        nothing = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for code, words in ((2, ["--responder", "human"]), (4, ["--view", "window"]),
                            (4, ["--tracker", "camera:63", "--camera-file", str(CAMERA)]),
                            (2, ["--tracker", "mouse"]), (2, ["--simulator", "nothing"]),
                            (2, ["--responder", "scripted"])):
            with self.subTest(words=words):
                done = self.heft("resume", "--db", db, *words, expect=code, environment=nothing)
                self.assertIn("heft: ", done.stderr)
                self.assertEqual([query(db, sql) for sql in rows], before)


if __name__ == "__main__":
    unittest.main()

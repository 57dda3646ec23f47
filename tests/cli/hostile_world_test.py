"""Sessions with interfering programs and invalid files: logs that are moved, linked, deleted or
locked while they are written, output that nobody reads, pipes and devices given as files, names
with special characters.

Run: python3 tests/cli/hostile_world_test.py PATH_TO_HEFT [-v]
"""
import os
import resource
import shlex
import shutil
import signal
import sqlite3
import stat
import subprocess
import time

from session_harness import PROTOCOLS, ROOT, SessionTest, change, main, outcome_of, query

SCENE = ROOT / "tests" / "scenes" / "pushes" / "push_200g.toml"
TRAJECTORY = ROOT / "tests" / "scenes" / "paths" / "push.csv"


class UnderARunningSession(SessionTest):
    def setUp(self):
        super().setUp()
        self.db = self.folder / "my lab.db"
        self.process = self.start_until_under_way(self.db)
        self.process.send_signal(signal.SIGSTOP)  # whatever is done to it is done in time
        self.addCleanup(self.process.kill)

    def locked(self):
        """The log, locked by another program, while the session is still under way."""
        other = sqlite3.connect(self.db, isolation_level=None, timeout=0.1)
        self.addCleanup(other.close)
        while True:
            try:
                other.execute("begin immediate")
                self.process.send_signal(signal.SIGCONT)
                return other
            except sqlite3.OperationalError:  # it was stopped while it wrote
                self.process.send_signal(signal.SIGCONT)
                time.sleep(0.005)
                self.process.send_signal(signal.SIGSTOP)

    def ends_with(self, code, seconds=60):
        self.process.send_signal(signal.SIGCONT)
        _, talk = self.process.communicate(timeout=seconds)
        self.assertEqual(self.process.returncode, code, talk)
        self.assertNotIn("all saved", talk if code else "")
        return talk

    def resumes_to_the_same_end(self, db):
        self.assertEqual(query(db, "pragma integrity_check"), [("ok",)])
        self.run_heft("resume", "--db", db)
        self.run_heft("replay", "--db", db)
        whole = self.folder / "whole.db"
        self.session(whole, protocol="jnd")
        self.assertEqual(outcome_of(db), outcome_of(whole))

    def beside(self):
        return [self.db.with_name(self.db.name + end) for end in ("-wal", "-shm")]

    def test_a_moved_log(self):
        away = self.folder / "away.db"
        self.db.rename(away)
        talk = self.ends_with(1)
        self.assertIn(f"moved to {away}", talk)
        self.assertIn("Move it back", talk)
        self.assertFalse(self.db.exists(), "another one was made in its place")
        away.rename(self.db)
        command = talk.strip().split("continue with: heft ")[1]
        self.run_heft(*shlex.split(command))
        self.run_heft("replay", "--db", self.db)

    def test_a_deleted_log(self):
        for file in [self.db, *self.beside()]:
            file.unlink(missing_ok=True)
        talk = self.ends_with(1)
        self.assertIn("was deleted", talk)
        rescued = self.folder / "my lab.db.rescued"
        self.assertIn(str(rescued), talk)
        rescued.rename(self.db)
        self.resumes_to_the_same_end(self.db)

    def test_a_replaced_log(self):
        other = self.folder / "other.db"
        self.session(other)
        before = other.read_bytes()
        other.rename(self.db)
        self.assertIn("was replaced by another file", self.ends_with(1))
        self.assertEqual(self.db.read_bytes(), before)
        self.resumes_to_the_same_end(self.folder / "my lab.db.rescued")

    def test_a_second_name(self):
        twin = self.folder / "twin.db"
        os.link(self.db, twin)
        self.assertIn("hard link", self.ends_with(1))
        self.run_heft("resume", "--db", self.db, expect=1)
        twin.unlink()
        self.resumes_to_the_same_end(self.db)

    def test_a_second_writer_under_any_name(self):
        twin, link = self.folder / "twin.db", self.folder / "link.db"
        os.link(self.db, twin)
        link.symlink_to(self.db)
        for name in (self.db, twin, link):
            done = self.session(name, participant="02", expect=1)
            self.assertIn("in use", done.stderr)
        twin.unlink()
        self.ends_with(0)
        self.assertFalse(list(self.folder.glob("*lock*")))

    def test_a_lock_is_waited_for_and_changes_nothing(self):
        other = self.locked()
        time.sleep(3)
        self.assertIsNone(self.process.poll(), "it did not wait")
        other.execute("rollback")
        other.close()
        self.assertIn("Database locked by another process; retrying.", self.ends_with(0))
        self.run_heft("replay", "--db", self.db)
        whole = self.folder / "whole.db"
        self.session(whole, protocol="jnd")
        self.assertEqual(outcome_of(self.db, frames=True), outcome_of(whole, frames=True))

    def test_without_a_person_a_lock_is_not_waited_for_forever(self):
        other = self.locked()
        talk = self.ends_with(1, seconds=120)
        self.assertIn("the file is locked by another program", talk)
        other.execute("rollback")
        other.close()
        self.resumes_to_the_same_end(self.db)


class Readers(SessionTest):
    def run_without_reader(self, *words, gone):
        read_end, write_end = os.pipe()
        os.close(read_end)
        try:
            return subprocess.run([self.heft, *map(str, words)], text=True, timeout=120,
                                  **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE,
                                     gone: write_end})
        finally:
            os.close(write_end)

    def test_messages_that_no_one_reads_end_nothing(self):
        db = self.folder / "s.db"
        done = self.run_without_reader("run", PROTOCOLS / "quick.toml", "--participant", "01",
                                       "--responder", "simulated", "--seed", 5, "--db", db,
                                       gone="stderr")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(query(db, "select state from session"), [("finished",)])

    def test_data_that_no_one_takes_is_an_error(self):
        done = self.run_without_reader("scene", SCENE, "--trajectory", TRAJECTORY, gone="stdout")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot write to the standard output: Broken pipe", done.stderr)

    def test_a_file_that_may_not_grow_is_reported(self):
        db = self.folder / "s.db"
        done = self.session(db, protocol="jnd", expect=1, preexec_fn=lambda: resource.setrlimit(
            resource.RLIMIT_FSIZE, (400_000, 400_000)))
        self.assertIn("largest size allowed", done.stderr)
        self.run_heft("resume", "--db", db)


class Names(SessionTest):
    def assertNothingToObey(self, done):
        for text in (done.stdout, done.stderr):
            self.assertFalse([c for c in text if c < " " and c not in "\n\t"], text)

    def test_a_terminal_obeys_no_file_name_id_or_cell(self):
        evil = "x\x1b]0;evil\x07\x1b[2J"
        protocol = self.folder / f"{evil}.toml"
        protocol.write_text("title = 3\n")
        self.assertNothingToObey(self.run_heft("validate", protocol, expect=3))
        cells = self.folder / "cells.csv"
        cells.write_text("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,\x1b[2J,0,0,1,0,0,0\n")
        self.assertNothingToObey(self.run_heft("scene", SCENE, "--trajectory", cells, expect=3))
        db = self.folder / f"{evil}.db"
        self.assertNothingToObey(self.session(db))
        change(db, f"update session set participant = '{evil}'")
        for words in (("analyse", "--db", db), ("replay", "--db", db),
                      ("run", PROTOCOLS / "quick.toml", "--participant", evil)):
            self.assertNothingToObey(self.run_heft(*words, expect=None))

    def test_commands_to_copy_work_for_any_name(self):
        db = self.folder / "it's $(touch loot) & \x1b.db"
        done = self.session(db)
        lines = [line.split(": ", 1)[1] for line in done.stderr.splitlines() if ": heft " in line]
        self.assertEqual(len(lines), 3, done.stderr)
        for command in lines:
            ran = subprocess.run(["bash", "-c", f"heft() {{ {shlex.quote(self.heft)} \"$@\"; }}; "
                                  + command], capture_output=True, cwd=self.folder, timeout=120)
            self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertFalse((self.folder / "loot").exists())


class Files(SessionTest):
    def test_pipes_and_devices_are_refused_at_once(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        for path in (pipe, "/dev/zero"):
            done = self.run_heft("validate", path, expect=1, timeout=20)
            self.assertIn("a device or a pipe, expected a file", done.stderr)

    def test_no_library_is_taken_from_where_somebody_is(self):
        needed = subprocess.run(["ldd", self.heft], capture_output=True, text=True, check=True).stdout
        libraries = [line.split()[0] for line in needed.splitlines() if " => " in line]
        self.assertIn("libsqlite3.so.0", libraries)
        for name in [*libraries, "heft-codecs.so", "heft-window.so"]:
            (self.folder / name).write_bytes(b"")
        self.run_heft("validate", PROTOCOLS / "paper.toml", cwd=self.folder)

    def test_a_sheet_writes_over_nothing_and_follows_no_link(self):
        out, link = self.folder / "mine.pdf", self.folder / "link.pdf"
        out.write_text("mine")
        link.symlink_to(self.folder / "nowhere.pdf")
        for path in (out, link):
            done = self.run_heft("sheet", "board", "--board",
                                 PROTOCOLS / "apparatus" / "board.toml", "--out", path, expect=1)
            self.assertIn("already exists", done.stderr)
        self.assertEqual(out.read_text(), "mine")
        self.assertFalse((self.folder / "nowhere.pdf").exists())

    def test_what_opencv_can_not_bear_is_refused(self):
        for text in ("<?xml version=", "%YAML:1.0\n---\na: [ !!binary [ !!binary [", "[" * 200_000):
            camera = self.folder / "camera.yaml"
            camera.write_text(text)
            done = self.run_heft("track", "--camera-file", camera, "--tracker", "synthetic",
                                 expect=None, timeout=20)
            self.assertIn(done.returncode, (2, 3), done.stderr)
            done = self.session(self.folder / "s.db", "--tracker", "synthetic", "--camera-file",
                                camera, expect=3, timeout=20)
            self.assertIn("camera.yaml:", done.stderr)

    def test_a_log_is_guarded_as_files_are(self):
        db = self.folder / "s.db"
        process = subprocess.Popen(
            [self.heft, "run", PROTOCOLS / "quick.toml", "--participant", "01", "--responder",
             "simulated", "--tracker", "synthetic", "--seed", "5", "--db", db],
            stderr=subprocess.DEVNULL)
        while process.poll() is None and not self.has_trial(db):
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        process.wait()
        untouched = db
        changes = ["run_options = json_set(run_options, '$.camera_text', '<?xml version=')",
                   "run_options = json_set(run_options, '$.camera_text', 'a: [ !!binary [')",
                   "run_options = '[[[[' || hex(zeroblob(1000000))", "run_options = '{\"view\":3}'",
                   "run_options = ''", f"protocol_text = '{'a.' * 100_000}a = 1'",
                   f"protocol_text = 'a = {'[' * 100_000}'", "started_utc = 'yesterday'"]
        for n, what in enumerate(changes):
            db = self.folder / f"{n}.db"
            shutil.copy(untouched, db)
            self.assertEqual(change(db, f"update session set {what}"), 1)
            for command in ("resume", "replay"):
                done = self.run_heft(command, "--db", db, expect=None, timeout=60)
                self.assertIn(done.returncode, (0, 1, 3, 5), done.stderr)
                if command == "resume":
                    self.assertNotEqual(done.returncode, 0)

    def test_a_changed_log_makes_no_file_and_opens_none(self):
        db = self.folder / "s.db"
        self.session(db, "--backup", self.folder / "copies")
        change(db, "update session set state = 'paused'")
        for column, name in (("view", "video:new.avi"), ("record_camera", "new"),
                             ("responder", "scripted:new")):
            changed = self.folder / f"{column}.db"
            shutil.copy(db, changed)
            self.assertEqual(change(changed, f"update setup set {column} = "
                                             f"replace('{name}', 'new', '{self.folder}/new')"), 1)
            done = self.run_heft("resume", "--db", changed, expect=5)
            self.assertIn("the log was changed", done.stderr)
            self.assertEqual(list(self.folder.glob("new*")), [])

    def has_trial(self, db):
        try:
            return query(db, "select count(*) from trial") > [(0,)]
        except sqlite3.Error:
            return False

    def test_numbers_beyond_the_earth_are_refused(self):
        far = self.folder / "far.csv"
        far.write_text("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,1e308,0,0,1,0,0,0\n")
        done = self.run_heft("scene", SCENE, "--trajectory", far, expect=3)
        self.assertIn("far.csv:3:3: x_m is 1e+308", done.stderr)

    def test_a_scene_never_prints_what_is_no_number(self):
        for key, value in (("mass_kg", 1e12), ("mass_kg", 1e-9), ("stiffness_n_per_m", 1e12),
                           ("gravity_m_s2", 1e12), ("friction", 1e12), ("position_m", "[1e6,0,1e6]"),
                           ("clone_mass_kg", 1e-9), ("size_m", 1e6)):
            scene = self.folder / "scene.toml"
            cube = {"mass_kg": 0.2, "size_m": 0.04, "position_m": "[0.1, 0, 0.02]"}
            coupling = {"condition": '"C2"'}
            top = {"friction": 0.5}
            for table in (cube, coupling, top):
                if key in table:
                    table[key] = value
            if key in ("stiffness_n_per_m", "clone_mass_kg"):
                coupling[key] = value
            if key == "gravity_m_s2":
                top[key] = value
            if key == "size_m":
                cube["position_m"] = "[0.1, 0, 600000]"
            lines = [f"{k} = {v}" for k, v in top.items()] + ["[coupling]"]
            lines += [f"{k} = {v}" for k, v in coupling.items()] + ["[[cube]]"]
            lines += [f"{k} = {v}" for k, v in cube.items()]
            scene.write_text("\n".join(lines) + "\n")
            for simulator in ("boxes", "bullet-ea", "auto"):
                with self.subTest(key=key, value=value, simulator=simulator):
                    done = self.run_heft("scene", scene, "--trajectory", TRAJECTORY, "--simulator",
                                         simulator, expect=None, timeout=120)
                    self.assertIn(done.returncode, (0, 1, 3), done.stderr)
                    self.assertNotRegex(done.stdout, "(?i)nan|inf")

    def test_recorded_pictures_and_logs_are_for_their_owner_alone(self):
        before = os.umask(0)
        try:
            pictures, db = self.folder / "pictures", self.folder / "s.db"
            process = subprocess.Popen(
                [self.heft, "run", PROTOCOLS / "quick.toml", "--participant", "01", "--responder",
                 "simulated", "--tracker", "synthetic", "--record-camera", pictures, "--view",
                 f"video:{self.folder}/seen.avi", "--seed", "5", "--db", db],
                stderr=subprocess.DEVNULL)
            while process.poll() is None and len(list(pictures.glob("*.png"))) < 3:
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            process.wait()
        finally:
            os.umask(before)
        files = [*pictures.iterdir(), db, self.folder / "seen.avi"]
        self.assertGreater(len(files), 6)
        self.assertEqual({stat.S_IMODE(file.stat().st_mode) for file in files}, {0o600})
        self.assertEqual(stat.S_IMODE(pictures.stat().st_mode), 0o700)


if __name__ == "__main__":
    main("__main__")

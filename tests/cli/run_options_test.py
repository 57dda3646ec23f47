"""Options that `heft run` refuses before anything is logged, and the files of resumed sessions.

Run: python3 tests/cli/run_options_test.py path/to/heft
"""
import signal
import subprocess
import time

from session_harness import PROTOCOLS, SessionTest, main

APPARATUS = PROTOCOLS / "apparatus"


class Options(SessionTest):
    def refused(self, code, *options):
        """@return the message; checks that no log, video or recording was written"""
        before = sorted(self.folder.iterdir())
        run = self.session(self.folder / "a.db", *options, expect=code, cwd=self.folder)
        self.assertEqual(run.stdout, "")
        self.assertNotIn("error of heft itself", run.stderr)
        self.assertEqual(sorted(self.folder.iterdir()), before)
        return run.stderr

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return str(self.folder / name)

    def test_broken_files_of_the_apparatus_are_refused_with_their_lines(self):
        camera = self.write("camera.yaml", "%YAML:1.0\n---\nimage_width: 640\nimage_height 480\n")
        said = self.refused(3, "--tracker", "synthetic", "--camera-file", camera)
        self.assertIn(f"{camera}:4:1: ", said)
        self.assertIn("heft calibrate camera", said)
        text = (APPARATUS / "board.toml").read_text(encoding="utf-8")
        board = self.write("board.toml", text.replace("pitch_m", "pich_m"))
        self.assertRegex(self.refused(3, "--tracker", "synthetic", "--board", board),
                         rf"{board}:\d+:1: .*\"pitch_m\"")
        text = (APPARATUS / "effector.toml").read_text(encoding="utf-8")
        effector = self.write("effector.toml", text.replace("tip = 30", "tip = 31"))
        self.assertRegex(self.refused(3, "--tracker", "synthetic", "--effector", effector),
                         rf"{effector}:\d+:\d+: ")

    def test_missing_ones_say_how_they_are_made_or_what_is_there(self):
        self.assertIn("heft calibrate camera",
                      self.refused(1, "--tracker", "synthetic", "--camera-file", "none.yaml"))
        said = self.refused(2, "--tracker", "frames:.")
        self.assertIn("heft calibrate camera", said)
        self.assertIn("camera.yaml in the current directory", said)
        self.assertIn("video63", self.refused(4, "--tracker", "camera:63", "--camera-file",
                                              str(APPARATUS / "synthetic_camera.yaml")))

    def test_the_calibration_of_this_folder_is_taken_and_named(self):
        self.write("camera.yaml", (APPARATUS / "synthetic_camera.yaml").read_text(encoding="utf-8"))
        said = self.refused(4, "--tracker", "camera:63")
        self.assertIn("camera calibration: camera.yaml\n", said)
        self.assertIn("video63", said)
        said = self.run_heft("doctor", "--tracker", "camera:63", expect=4, cwd=self.folder).stderr
        self.assertIn("camera calibration: camera.yaml\n", said)
        named = self.write("mine.yaml", "%YAML:1.0\n---\n")
        said = self.refused(3, "--tracker", "camera:63", "--camera-file", named)
        self.assertNotIn("camera calibration", said)
        # The synthetic camera ignores the calibration in this folder.
        self.write("camera.yaml", "%YAML:1.0\n---\n")
        self.assertIn("none.yaml", self.refused(1, "--tracker", "synthetic", "--effector",
                                                "none.yaml"))

    def test_a_text_file_is_checked_even_where_a_model_reads_nothing(self):
        text = (PROTOCOLS / "texts" / "en.toml").read_text(encoding="utf-8")
        texts = self.write("texts.toml", text.replace("\nnext = ", "\nnxt = "))
        said = self.refused(3, "--language", texts)
        self.assertRegex(said, rf"{texts}:\d+:1: unknown key \"nxt\"")
        self.assertIn('"next"', said)
        self.assertIn('"fr"', self.refused(2, "--language", "de"))

    def test_a_video_is_never_written_over(self):
        self.write("film.avi", "mine")
        self.assertIn("film.avi already exists", self.refused(1, "--view", "video:film.avi"))
        self.assertEqual((self.folder / "film.avi").read_text(), "mine")

    def test_a_resumed_session_continues_in_a_part_of_its_own(self):
        db, film = self.folder / "a.db", self.folder / "film.avi"
        process = subprocess.Popen(
            [self.heft, "run", PROTOCOLS / "jnd.toml", "--participant", "01", "--responder",
             "simulated", "--seed", "5", "--db", db, "--view", f"video:{film}"],
            stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not self.is_under_way(db):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        first = film.read_bytes()
        process = subprocess.Popen([self.heft, "resume", "--db", db], stderr=subprocess.PIPE,
                                   text=True)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertIn(process.returncode, (0, 130), said)
        self.assertIn("film-2.avi", said)
        self.assertTrue((self.folder / "film-2.avi").exists())
        self.assertEqual(film.read_bytes(), first)

    def test_a_mistake_in_a_setting_is_one_of_set(self):
        for setting, expected in {"coupling.stiffness_n_per_m=nan": "--set: stiffness_n_per_m is nan",
                                  "coupling.stiffnes=3": '--set: unknown key "stiffnes"',
                                  "layout.area_m=[1, 'x']": "--set: area_m is"}.items():
            done = self.run_heft("simulate", PROTOCOLS / "quick.toml", "--set", setting, "--db",
                                 self.folder / "none.db", expect=None)
            self.assertNotEqual(done.returncode, 0, setting)
            self.assertIn(expected, done.stderr)


if __name__ == "__main__":
    main(__name__)

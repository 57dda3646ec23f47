"""Responders on logged frames, what a what-if would be noticed by, and logs shown again.

Run: python3 tests/cli/replay_responder_test.py PATH_TO_HEFT
"""
import collections
import json
import shutil
import struct

from session_harness import PROTOCOLS, SessionTest, change, main, query

SORTING = """
title = "Sorting and constant stimuli"
[[block]]
kind = "introduction"
name = "introduction"
masses_g = [15, 800]
[[block]]
kind = "sorting"
name = "sorting"
masses_g = [15, 200, 800]
trials = 6
c1_trials = 3
[[block]]
kind = "comparison"
name = "comparison"
catch_fraction = 0
[[block.staircase]]
name = "constant"
kind = "constant"
reference_g = 200
levels = [-100, 0, 80, 300]
n_per_level = 4
"""
TWO_TRIALS = """
title = "Two trials"
[[block]]
kind = "sorting"
name = "sorting"
masses_g = [15, 200, 800]
trials = 2
c1_trials = 1
"""
# Who finds cubes so alike that the introduction's first choice is often wrong.
BLIND = "judgment_noise_mm = 50\nmemory_noise = 1\nlapse_rate = 0.5\n"


class ReplayResponder(SessionTest):
    def setUp(self):
        super().setUp()
        self.db = self.folder / "a.db"
        self.protocol = self.write("p.toml", SORTING)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def run_model(self, db, responder, *words, protocol=None, participant="01", seed=7):
        self.run_heft("run", protocol or self.protocol, "--participant", participant,
                      "--responder", responder, "--seed", seed, "--db", db, *words,
                      cwd=self.folder)

    def judged(self, *words, db=None):
        said = self.run_heft("replay", "--db", db or self.db, *words, "--json").stdout
        return json.loads(said)["sessions"]

    def table_of(self, session, task):
        """(logged, judged) -> n over the groups of a task."""
        table = collections.Counter()
        for group in session["groups"]:
            if group["task"] == task:
                table.update({(row["logged"], row["judged"]): row["n"] for row in group["table"]})
        return table

    def assert_agrees_with_itself(self, session):
        n = query(self.db, "select count(*) from trial where status = 'completed' and session_id = "
                           f"{session['session']}")[0][0]
        self.assertGreater(n, 0)
        self.assertEqual((session["n"], session["agree"]), (n, n))
        for group in session["groups"]:
            self.assertEqual(group["logged"], group["judged"])
            if group["labels"]:
                self.assertEqual(group["labels"]["agree"], group["labels"]["n"])
        self.assertGreater(session["times_real_time"], 100)

    def test_the_default_responder_agrees_with_its_own_logs(self):
        self.session(self.db, protocol="recommended")
        self.session(self.db, protocol="paper", participant="02", seed=6)
        sessions = self.judged("--responder", "simulated")
        self.assertEqual(len(sessions), 2)
        for session in sessions:
            self.assert_agrees_with_itself(session)

    def test_logged_parameters_are_taken_without_their_file(self):
        blind = self.write("blind.toml", BLIND)
        for seed in range(1, 9):
            self.run_model(self.db, f"simulated:{blind}", participant=f"{seed:02}", seed=seed)
        blind.unlink()
        sessions = self.judged("--responder", "simulated")
        for session in sessions:
            self.assert_agrees_with_itself(session)
        first = set().union(*(self.table_of(session, "introduction") for session in sessions))
        self.assertEqual(first, {("heaviest", "heaviest"), ("other", "other")})
        sharp = self.write("sharp.toml",
                           "judgment_noise_mm = 0\nmemory_noise = 0\nlapse_rate = 0\n")
        with_file = self.judged("--responder", f"simulated:{sharp}", "--session", 1)[0]
        self.assertLess(with_file["agree"], with_file["n"])

    def test_the_confusion_table_is_that_of_two_logs(self):
        """A coin answers a trial the same in its own session: SQL makes the table from both."""
        self.run_model(self.db, "simulated")
        coins = self.folder / "coin.db"
        self.run_model(coins, "coin")
        session = self.judged("--responder", "coin")[0]
        answers = """select trial_number, task, outcome, chosen_slot, reference_slot
                     from trial where status = 'completed'"""
        logged = {row[0]: row for row in query(self.db, answers)}
        coin = {row[0]: row for row in query(coins, answers)}
        self.assertEqual(logged.keys(), coin.keys())
        sorting, comparison = collections.Counter(), collections.Counter()
        for number, (_, task, outcome, slot, reference_slot) in logged.items():
            if task == "sorting":
                sorting[outcome, coin[number][2]] += 1

            def choice(chosen):
                if chosen is None:
                    return "none"
                return "reference" if chosen == reference_slot else "comparison"

            if task == "comparison":
                comparison[choice(slot), choice(coin[number][3])] += 1
        self.assertEqual(self.table_of(session, "sorting"), sorting)
        self.assertEqual(self.table_of(session, "comparison"), comparison)
        self.assertGreater(len(comparison), 3)
        group = [g for g in session["groups"] if g["task"] == "comparison"][0]
        self.assertEqual((group["condition"], group["reference_g"], group["n"]), ("C2", 200, 16))
        self.assertTrue(group["agree_low"] <= group["agree"] / 16 <= group["agree_high"])
        for who in "logged", "judged":
            self.assertGreater(group[who]["d_prime_se"], 0)

    def test_nothing_of_the_logged_session_is_opened(self):
        two = self.write("two.toml", TWO_TRIALS)
        camera = self.folder / "camera.yaml"
        shutil.copy(PROTOCOLS / "apparatus" / "synthetic_camera.yaml", camera)
        self.run_model(self.db, "simulated", "--tracker", "synthetic", "--camera-file", camera,
                       "--record-camera", "filmed", "--view", "video:a.avi", protocol=two)
        self.run_model(self.db, "simulated", "--tracker", "frames:filmed", "--camera-file", camera,
                       "--view", "video:b.avi", protocol=two, participant="02")
        for path in self.folder.iterdir():
            if path != self.db:
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        for session in self.judged("--responder", "simulated"):
            self.assert_agrees_with_itself(session)
        self.assertIn("would be", self.run_heft("replay", "--db", self.db, "--responder", "coin",
                                                "--rerun").stdout)
        self.run_heft("replay", "--db", self.db, "--set", "physics.friction=0.5")
        self.assertEqual({path.name for path in self.folder.iterdir()} -
                         {"a.db", "a.db-wal", "a.db-shm"}, set())

    def test_trials_without_frames_are_told(self):
        self.run_heft("simulate", self.protocol, "--participants", 1, "--seed", 3, "--db", self.db)
        said = self.run_heft("replay", "--db", self.db, "--responder", "coin").stdout
        self.assertIn("without frames", said)
        session = self.judged("--responder", "coin")[0]
        self.assertEqual(session["n"], 0)
        self.assertEqual(session["n_without_frames"],
                         query(self.db, "select count(*) from trial")[0][0])

    def test_a_changed_log_is_not_judged(self):
        self.session(self.db)
        change(self.db, "update frame set trial_t_s = trial_t_s + 1e9 where frame_id = 40")
        for words in (["--responder", "coin"], ["--set", "physics.friction=0.5"],
                      ["--view", "video:" + str(self.folder / "v.avi")]):
            said = self.run_heft("replay", "--db", self.db, *words, expect=5).stderr
            self.assertIn("the log was changed", said)

    def test_what_does_not_go_together_is_refused(self):
        self.session(self.db)
        for words in (["--rerun"], ["--json"], ["--responder", "coin", "--rerun", "--json"],
                      ["--responder", "coin", "--set", "physics.friction=0.5"],
                      ["--responder", "coin", "--view", "video:v.avi"], ["--view", "headless"],
                      ["--view", "video"], ["--responder", "human"], ["--responder", "scripted"],
                      ["--tables"], ["--responder", "coin", "--rerun", "--tables"],
                      ["--view", "video:v.avi", "--set", "physics.friction=0.5", "--tables"]):
            self.run_heft("replay", "--db", self.db, *words, expect=2, cwd=self.folder)
        self.assertEqual([p.name for p in self.folder.iterdir() if "v.avi" in p.name], [])

    def test_a_what_if_tells_lags_and_paths(self):
        self.session(self.db)
        said = self.run_heft("replay", "--db", self.db, "--set",
                             "coupling.stiffness_n_per_m=100", "--tables").stdout
        self.assertIn("clone RMS", said)
        row = next(line.split() for line in said.splitlines()
                   if line.split()[:3] == ["sorting", "C2", "200"])
        numbers = [float(word) for word in row[3:] if word != ">"]
        lag_mm, would_be_mm = numbers[2:4]
        self.assertGreater(lag_mm, 30)
        self.assertAlmostEqual(would_be_mm, lag_mm / 2, delta=0.15 * lag_mm)

    def test_one_session_fits_a_screen(self):
        protocol = PROTOCOLS / "paper.toml"
        self.run_heft("simulate", protocol, "--participants", 1, "--seed", 3, "--frames", "--db",
                      self.db)
        for words in ["--set", "coupling.stiffness_n_per_m=100"], ["--responder", "coin"]:
            short = self.run_heft("replay", "--db", self.db, *words).stdout
            every = self.run_heft("replay", "--db", self.db, *words, "--tables").stdout
            self.assertIn("--tables", short)
            self.assertLessEqual(len(short.splitlines()), 24)
            self.assertLessEqual(max(map(len, short.splitlines())), 80)
            self.assertGreater(len(every.splitlines()), 40)

    def test_a_video_holds_every_frame(self):
        self.session(self.db)
        n = query(self.db, "select count(*) from frame")[0][0]
        videos = {}
        for name, words in (("logged", []), ("both", ["--set", "coupling.stiffness_n_per_m=200"])):
            path = self.folder / f"{name}.avi"
            said = self.run_heft("replay", "--db", self.db, "--view", f"video:{path}",
                                 *words).stdout
            self.assertIn(f"{n} frames shown", said)
            videos[name] = path.read_bytes()
            header = videos[name].find(b"avih")  # dwTotalFrames: its fifth number
            self.assertEqual(struct.unpack_from("<I", videos[name], header + 24)[0], n)
        self.assertNotEqual(videos["logged"], videos["both"])


if __name__ == "__main__":
    main("__main__")

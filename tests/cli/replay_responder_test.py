"""Responders on logged frames, visible differences of what-if simulations, and display of logs.

Run: python3 tests/cli/replay_responder_test.py PATH_TO_HEFT
"""
import collections
import json
import math
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
# A responder whose first choice in the introduction is often wrong.
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
        return json.loads(said)

    def assert_all_judged(self, judged):
        n = query(self.db, "select count(*) from trial where status = 'completed'")[0][0]
        self.assertGreater(n, 0)
        self.assertEqual(len(judged["trials"]), n)
        self.assertEqual(judged["all"]["n_trials"], n)
        self.assertGreater(judged["times_real_time"], 100)
        for trial in judged["trials"]:
            for model in trial["probabilities"].values():
                self.assertLessEqual(sum(model.values()), 1)

    def test_sessions_are_pooled_and_models_stand_side_by_side(self):
        self.session(self.db, protocol="recommended")
        self.session(self.db, protocol="paper", participant="02", seed=6)
        names = ["simulated", "criterion_only", "coin"]
        words = [word for name in names for word in ("--responder", name)]
        judged = self.judged(*words, "--repeats", 50, "--seed", 3)
        self.assert_all_judged(judged)
        self.assertEqual((judged["n_sessions"], judged["repeats"], judged["seed"]), (2, 50, 3))
        models = judged["all"]["responders"]
        self.assertEqual([model["responder"] for model in models], names)
        simulated, blind = models[:2]
        low, high = simulated["log_score"]["interval"]
        self.assertTrue(low < simulated["own_log_score"]["value"] < high)
        self.assertGreater(simulated["log_score"]["value"], judged["all"]["shares"]["value"])
        self.assertLess(blind["log_score"]["value"], judged["all"]["chance"])
        self.assertEqual(blind["n_people_better"], 0)
        self.assertAlmostEqual(
            blind["difference"]["value"],
            blind["log_score"]["value"] - simulated["log_score"]["value"], places=9)
        again = self.judged(*words, "--repeats", 50, "--seed", 3)
        for found in judged, again:
            del found["times_real_time"]
        self.assertEqual(again, judged)

    def test_the_figures_follow_from_each_trials_probabilities(self):
        self.run_model(self.db, "simulated")
        judged = self.judged("--responder", "simulated")
        answers = dict(query(self.db, """select trial_number, case when chosen_slot is null then 'none'
            when chosen_slot = reference_slot then 'reference' else 'comparison' end
            from trial where task = 'comparison' and status = 'completed'"""))
        scores, n_by_pair = [], collections.Counter()
        for trial in judged["trials"]:
            if trial["task"] != "comparison":
                continue
            self.assertEqual(trial["answer"], answers.pop(trial["trial_number"]))
            probabilities = trial["probabilities"]["simulated"]
            scores.append(math.log(probabilities.get(trial["answer"], 0.5 / 101.5)))
            for answer, probability in probabilities.items():
                n_by_pair[trial["answer"], answer] += (probability * 101.5 - 0.5) / 100
        self.assertEqual(answers, {})
        group = [g for g in judged["groups"] if g["task"] == "comparison"][0]
        self.assertEqual((group["condition"], group["reference_g"], group["n_trials"]),
                         ("C2", 200, 16))
        model = group["responders"][0]
        self.assertAlmostEqual(model["log_score"]["value"], sum(scores) / len(scores), places=9)
        self.assertIsNone(model["log_score"]["interval"], "one person")
        for row in model["answers"]:
            self.assertAlmostEqual(row["n"], n_by_pair.pop((row["logged"], row["judged"])), places=6)
        self.assertEqual(len(n_by_pair), 0)

    def test_logged_parameters_are_taken_without_their_file(self):
        blind = self.write("blind.toml", BLIND)
        for seed in range(1, 7):
            self.run_model(self.db, f"simulated:{blind}", participant=f"{seed:02}", seed=seed)
        kept = self.folder / "kept.toml"
        blind.rename(kept)
        sharp = self.write("sharp.toml",
                           "judgment_noise_mm = 0\nmemory_noise = 0\nlapse_rate = 0\n")
        judged = self.judged("--responder", "simulated", "--responder", f"simulated:{kept}",
                             "--responder", f"simulated:{sharp}")
        same, population, other = [model["log_score"]["value"]
                                   for model in judged["all"]["responders"]]
        self.assertGreater(same, population - 0.05)
        self.assertGreater(same, other + 0.2)

    def test_a_what_if_is_judged(self):
        self.run_model(self.db, "simulated")
        as_seen = self.judged("--responder", "simulated")["trials"]
        stiff = self.judged("--responder", "simulated", "--set",
                            "coupling.stiffness_n_per_m=5000")["trials"]
        self.assertEqual(len(stiff), len(as_seen))
        same = self.judged("--responder", "simulated", "--set",
                           "coupling.stiffness_n_per_m=50")["trials"]
        self.assertEqual(same, as_seen, "the stiffness that it had")

        def chance_of_none(trials):
            return sum(trial["probabilities"]["simulated"].get("none", 0) for trial in trials)
        self.assertGreater(chance_of_none(stiff), 2 * chance_of_none(as_seen))

    def test_a_chart_is_drawn(self):
        self.run_model(self.db, "simulated")
        chart = self.folder / "models.svg"
        words = ["replay", "--db", self.db, "--responder", "simulated", "coin", "--chart"]
        self.assertIn("models.svg", self.run_heft(*words, chart).stdout)
        drawn = chart.read_text(encoding="utf-8")
        for text in "simulated", "coin", "chance", "comparison", "200 g", "seed 1":
            self.assertIn(text, drawn)
        self.assertEqual([p.name for p in self.folder.glob("models*")], ["models.svg"])
        self.run_heft(*words, self.folder / "missing" / "m.svg", expect=1)
        self.run_heft(*words, "models.png", expect=2)

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
        self.assert_all_judged(self.judged("--responder", "simulated"))
        self.assertIn("would be", self.run_heft("replay", "--db", self.db, "--responder", "coin",
                                                "--rerun").stdout)
        self.run_heft("replay", "--db", self.db, "--set", "physics.friction=0.5")
        self.assertEqual({path.name for path in self.folder.iterdir()} -
                         {"a.db", "a.db-wal", "a.db-shm"}, set())

    def test_trials_without_frames_are_reported(self):
        self.run_heft("simulate", self.protocol, "--participants", 1, "--seed", 3, "--db", self.db)
        said = self.run_heft("replay", "--db", self.db, "--responder", "coin").stdout
        self.assertIn("without frames", said)
        judged = self.judged("--responder", "coin")
        self.assertEqual((judged["trials"], judged["all"]), ([], None))
        self.assertEqual(len([t for t in judged["left_out"] if t["why"] == "without frames in the log"]),
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
                      ["--responder", "coin", "--responder", "simulated", "--rerun"],
                      ["--repeats", "5"], ["--chart", "a.svg"], ["--seed", "1"],
                      ["--responder", "coin", "--repeats", "1"],
                      ["--responder", "coin", "--set", "block.sorting.trials=2"],
                      ["--responder", "coin", "--view", "video:v.avi"], ["--view", "headless"],
                      ["--view", "video"], ["--responder", "human"], ["--responder", "scripted"],
                      ["--tables"], ["--responder", "coin", "--rerun", "--tables"],
                      ["--view", "video:v.avi", "--set", "physics.friction=0.5", "--tables"]):
            self.run_heft("replay", "--db", self.db, *words, expect=2, cwd=self.folder)
        self.assertEqual([p.name for p in self.folder.iterdir() if "v.avi" in p.name], [])

    def test_a_what_if_shows_lags_and_paths(self):
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
        long_name = self.write("a_long_name_of_a_model_of_people.toml", "lapse_rate = 0.1\n")
        names = [f"simulated:{long_name}", "criterion_only", "coin", "always_yes", "always_no", "simulated"]
        for words in (["--set", "coupling.stiffness_n_per_m=100"], ["--responder", "simulated"],
                      ["--responder", *names[1:4]], ["--responder", *names]):
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

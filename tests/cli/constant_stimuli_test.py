"""Sessions with constant stimuli: run, interrupted, simulated, replayed and analysed.

Run: python3 tests/cli/constant_stimuli_test.py PATH_TO_HEFT
"""
import json
import subprocess
import time

from session_harness import SessionTest, main, outcome_of, query

LEVELS = [-100, 0, 80, 300, 600]
PROTOCOL = """
title = "Constant stimuli beside a staircase"
[[block]]
kind = "comparison"
name = "comparison"
catch_fraction = 0.1
[[block.staircase]]
name = "constant"
kind = "constant"
reference_g = 200
levels = [-100, 0, 80, 300, 600]
n_per_level = 6
[[block.staircase]]
name = "staircase"
reference_g = 15
start = 175
step = 50
floor = 0
stop_reversals = 3
stop_trials = 10
discard_reversals = 1
"""


class ConstantStimuli(SessionTest):
    def setUp(self):
        super().setUp()
        self.protocol = self.folder / "constant.toml"
        self.protocol.write_text(PROTOCOL)
        self.db = self.folder / "s.db"

    def words(self, db):
        return ["run", self.protocol, "--participant", "01", "--responder", "simulated", "--seed",
                "5", "--db", db]

    def analysed(self, db):
        return json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)

    def assert_whole(self, db):
        for (session,) in query(db, "select session_id from session"):
            self.assertEqual(
                query(db, "select level_g, count(*) from trial where status = 'completed' and "
                          f"staircase = 'constant' and session_id = {session} group by level_g"),
                [(level, 6) for level in LEVELS])
        self.assertEqual(
            set(query(db, "select method, jnd_g, n_trials, n_reversals, reason from estimate "
                          "where staircase = 'constant'")), {("constant", None, 30, 0, "trials")})
        self.assertEqual(query(db, "select * from reversal where staircase = 'constant'"), [])
        self.assertIn("verified", self.run_heft("replay", "--db", db).stdout)

    def test_a_session_runs_replays_and_gives_no_jnd(self):
        self.run_heft(*self.words(self.db))
        self.assert_whole(self.db)
        self.run_heft("replay", "--db", self.db, "--responder", "coin")
        out = self.folder / "report"
        self.run_heft("analyse", "--db", self.db, "--out", out)
        analysed = self.analysed(self.db)
        self.assertEqual([(jnd["reference_g"], jnd["n_unfinished"]) for jnd in analysed["jnd"]],
                         [(15, 0)])
        listed = (out / "staircases.csv").read_text()
        self.assertNotIn("constant", listed)
        by_level = (out / "choices_by_level.csv").read_text()
        self.assertEqual(sum(line.startswith("simulated,200,") for line in by_level.splitlines()), 5)

    def test_a_killed_session_resumes_to_the_same_end(self):
        self.run_heft(*self.words(self.folder / "whole.db"))
        process = subprocess.Popen([self.heft, *map(str, self.words(self.db))],
                                   stderr=subprocess.DEVNULL)
        while process.poll() is None and not self.is_under_way(self.db):
            time.sleep(0.01)
        self.assertIsNone(process.poll(), "it was over before it could be stopped")
        process.kill()
        process.communicate()
        [jnd] = [jnd for jnd in self.analysed(self.db)["jnd"] if jnd["reference_g"] == 15] or [None]
        self.assertTrue(jnd is None or jnd["mean_g"] is None)
        self.assertNotIn(200, [jnd["reference_g"] for jnd in self.analysed(self.db)["jnd"]])
        self.run_heft("resume", "--db", self.db)
        self.assert_whole(self.db)
        self.assertEqual(outcome_of(self.db), outcome_of(self.folder / "whole.db"))

    def test_simulated_sessions_are_whole(self):
        self.run_heft("simulate", self.protocol, "--responder", "coin", "--participants", 3, "--db",
                      self.db, "--seed", 2)
        self.assert_whole(self.db)
        orders = query(self.db, "select group_concat(level_g) from trial where staircase = "
                                "'constant' group by session_id")
        self.assertEqual(len(set(orders)), 3, "each session has an order of its own")

    def test_validate_counts_its_trials(self):
        only_constant = PROTOCOL[:PROTOCOL.rindex("[[block.staircase]]")].replace("0.1", "0")
        self.protocol.write_text(only_constant)
        self.assertIn("about 30 trials", self.run_heft("validate", self.protocol).stdout)
        self.protocol.write_text(only_constant.replace("-100", "-200"))
        refused = self.run_heft("validate", self.protocol, expect=3).stderr
        self.assertIn(":11:11", refused)
        self.assertIn("weigh 0 g or less", refused)

    def test_fits_of_forced_choices_are_judged_where_stimuli_were_constant(self):
        self.protocol.write_text(
            'title = "Forced choices"\n[[block]]\nkind = "comparison"\nname = "comparison"\n'
            'answers = "heavier"\n[[block.staircase]]\nname = "constant"\nkind = "constant"\n'
            "reference_g = 400\nlevels = [-300, -200, -100, 100, 200, 300]\nn_per_level = 12\n"
            '[[block.staircase]]\nname = "adaptive"\nreference_g = 200\nstart = 100\nstep = 20\n'
            "floor = 0\nceiling = 400\nstop_reversals = 8\nstop_trials = 40\n")
        self.run_heft("simulate", self.protocol, "--responder", "simulated", "--participants", 3,
                      "--seed", 3, "--db", self.db)
        rows = {row["reference_g"]: row for row in self.analysed(self.db)["forced_choice"]}
        self.assertEqual(rows[400]["n_fits_judged"], rows[400]["n"])
        self.assertGreater(rows[400]["n"], 0)
        self.assertEqual(rows[200]["n_fits_judged"], 0)
        self.assertIsNone(rows[200]["n_fits_rejected"])
        self.assertIn("an adaptive procedure chose the differences", rows[200]["fits_why"])

    def test_a_session_of_constant_stimuli_alone_has_no_jnd_at_all(self):
        self.protocol.write_text(PROTOCOL[:PROTOCOL.rindex("[[block.staircase]]")])
        self.run_heft(*self.words(self.db))
        self.assert_whole(self.db)
        done = self.run_heft("analyse", "--db", self.db, "--tables")
        self.assertIn("JND: no staircases that estimate one.", done.stdout)
        self.assertEqual(self.analysed(self.db)["jnd"], [])


if __name__ == "__main__":
    main("__main__")

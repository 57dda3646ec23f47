"""Sessions through the command line: run, resume, simulate, replay, and errors.

Run: python3 tests/cli/session_test.py PATH_TO_HEFT
"""
import contextlib
import json
import shutil
import sqlite3

from session_harness import PROTOCOLS, SessionTest, change, main, outcome_of, query


class Running(SessionTest):
    def test_a_session_is_logged_whole(self):
        db = self.folder / "s.db"
        self.session(db, participant="007")
        [(participant, state, purpose, responder, seed)] = query(
            db, "select participant, state, purpose, responder, seed from session")
        self.assertEqual((participant, state, purpose, responder, seed),
                         ("007", "finished", "simulated", "simulated", 5))
        self.assertEqual(query(db, "pragma integrity_check"), [("ok",)])
        self.assertEqual(query(db, "pragma foreign_key_check"), [])
        [(open_trials,)] = query(db, "select count(*) from trial where status = 'open'")
        self.assertEqual(open_trials, 0)
        # Response time is what the design says, and a whole number of microseconds or so.
        for (response_s,) in query(db, "select validated_s - shown_s - paused_s - lost_s from trial"):
            self.assertGreater(response_s, 1)
            self.assertEqual(response_s * 2**20, round(response_s * 2**20))

    def test_equal_seeds_give_equal_sessions_in_fresh_processes(self):
        for name in ("a.db", "b.db"):
            self.session(self.folder / name)
        self.assertEqual(outcome_of(self.folder / "a.db", frames=True),
                         outcome_of(self.folder / "b.db", frames=True))
        self.session(self.folder / "c.db", seed=6)
        self.assertNotEqual(outcome_of(self.folder / "a.db"), outcome_of(self.folder / "c.db"))

    def test_second_prints_of_a_tag_are_listed_and_shown(self):
        db = self.folder / "s.db"
        self.session(db)
        for command in ("list", "show"):
            self.assertNotIn("double", self.run_heft(command, "--db", db).stdout)
        # As a session with a camera logs it.
        with contextlib.closing(sqlite3.connect(db)) as log:
            log.execute("insert into event (session_id, t_s, kind, detail, digest) values (1, 9, 'camera', "
                        """'{"shown":200,"dropped":1,"late":2,"doubled":50}', '')""")
            log.commit()
        listed = self.run_heft("list", "--db", db).stdout
        self.assertIn("doubled", listed)
        self.assertIn("25.0 %", listed)
        self.assertIn("50 of them show a second print of a tag", self.run_heft("show", "--db", db).stdout)
        [row] = json.loads(self.run_heft("list", "--db", db, "--json").stdout)
        self.assertEqual((row["n_pictures"], row["n_doubled"]), (200, 50))

    def test_a_finished_session_is_repeated_only_on_purpose(self):
        db = self.folder / "s.db"
        self.session(db)
        self.assertIn("--again", self.session(db, expect=2).stderr)
        self.session(db, "--again")
        self.session(db, participant="02")
        self.assertEqual(query(db, "select count(*) from session"), [(3,)])

    def test_an_unfinished_session_points_to_resume(self):
        db = self.folder / "s.db"
        self.session(db)
        change(db, "update session set state = 'running'")
        self.assertIn("heft resume", self.session(db, "--again", expect=2).stderr)

    def test_a_person_needs_a_camera_and_is_never_faked(self):
        done = self.run_heft("run", PROTOCOLS / "quick.toml", "--participant", "1", "--tracker",
                             "camera:63", "--db", self.folder / "s.db", expect=4)
        self.assertIn("there is no camera /dev/video63", done.stderr)
        self.assertFalse((self.folder / "s.db").exists())

    def test_unknown_names_are_refused_with_the_nearest(self):
        for words, nearest in ((["--responder", "simulatd"], "simulated"),
                               (["--simulator", "bulet"], "bullet"), (["--view", "x"], "headless"),
                               (["--tracker", "x"], "hand")):
            responder = [] if "--responder" in words else ["--responder", "simulated"]
            done = self.run_heft("run", PROTOCOLS / "quick.toml", "--participant", "1", "--db",
                                 self.folder / "s.db", *words, *responder, expect=2)
            self.assertIn(nearest, done.stderr)

    def test_every_model_finishes_a_session(self):
        for responder in ("always_yes", "always_no", "coin", "criterion_only"):
            db = self.folder / f"{responder}.db"
            self.run_heft("run", PROTOCOLS / "quick.toml", "--participant", "1", "--responder",
                          responder, "--seed", 1, "--db", db)
            self.assertEqual(query(db, "select state from session"), [("finished",)])

    def test_ctrl_c_saves_everything_and_resume_continues(self):
        whole, db = self.folder / "whole.db", self.folder / "s.db"
        self.session(whole, protocol="jnd")
        process = self.start_until_under_way(db)
        process.send_signal(2)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("heft resume", said)
        self.assertEqual(query(db, "select state from session"), [("paused",)])
        self.run_heft("resume", "--db", db)
        self.assertEqual(outcome_of(db), outcome_of(whole))

    def test_a_session_can_be_ended_for_somebody_who_will_not_come_back(self):
        db = self.folder / "s.db"
        self.kill_under_way(db)
        said = self.run_heft("resume", "--db", db, "--end", expect=2).stderr
        self.assertIn("--session", said)
        self.run_heft("resume", "--db", db, "--end", "--session", 1)
        self.assertEqual(query(db, "select state from session"), [("aborted",)])
        self.assertEqual(query(db, "select count(*) from trial where status = 'open'"), [(0,)])
        self.run_heft("replay", "--db", db)
        self.run_heft("resume", "--db", db, expect=1)
        self.session(db, "--again", protocol="jnd")

    def test_simulation_gives_the_same_data_for_any_number_of_jobs(self):
        for jobs in (1, 3):
            self.run_heft("simulate", PROTOCOLS / "quick.toml", "--participants", 5, "--jobs", jobs,
                          "--seed", 9, "--db", self.folder / f"{jobs}.db", "--frames")
        for table in ("trial", "cube", "answer", "event", "reversal", "estimate", "frame"):
            rows = [query(self.folder / f"{jobs}.db", f"select * from {table}") for jobs in (1, 3)]
            self.assertEqual(rows[0], rows[1], table)
        participants = query(self.folder / "1.db", "select participant, seed from session")
        self.assertEqual([p for p, _ in participants], [f"sim-{n:04}" for n in range(1, 6)])
        self.assertEqual(len({seed for _, seed in participants}), 5)
        self.run_heft("replay", "--db", self.folder / "3.db")

    def test_a_demo_leaves_a_log_and_a_report(self):
        done = self.run_heft("demo", cwd=self.folder, timeout=3000)
        self.assertTrue((self.folder / "heft-demo/report/report.html").exists())
        lines = (done.stderr + done.stdout).splitlines()
        self.assertLessEqual(len(lines), 25, done.stdout)
        self.assertLessEqual(max(map(len, lines)), 80, done.stdout)
        results = " ".join(done.stdout.split())
        self.assertRegex(results, r"Sorting: with decoupling \(C2\) (all 5|\d of 5) were correct, ")
        self.assertRegex(results, r"; without decoupling \(C1\) ")
        self.assertIn("One simulated participant: nothing here is about people", results)
        self.assertIn("Report: heft-demo/report/report.html", results)
        self.run_heft("replay", "--db", self.folder / "heft-demo/demo.db")


class ScriptedHand(SessionTest):
    """A recorded hand, given as files."""

    def record(self):
        folder = self.folder / "hand"
        folder.mkdir()
        header = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n"
        turned = "0.7071067811865476,0,0,0.7071067811865476"  # the tip points away from the participant
        for trial in (1, 2):
            rows = [f"{t},-0.04,{y},0.025,{turned}" for t, y in
                    ((0, -0.13), (1, -0.13), (2, 0.0), (3, -0.13), (9, -0.13))]
            (folder / f"trial_{trial}.csv").write_text(header + "\n".join(rows) + "\n")
        return folder

    PROTOCOL = """title = "two comparisons"
[[block]]
kind = "comparison"
name = "comparison"
[[block.staircase]]
name = "200g"
reference_g = 200
start = 600
step = 100
floor = 0
stop_reversals = 1
discard_reversals = 0
"""

    def run_recorded(self, folder, expect=0):
        protocol = self.folder / "two.toml"
        protocol.write_text(self.PROTOCOL)
        return self.run_heft("run", protocol, "--participant", "1", "--responder",
                             f"scripted:{folder}", "--seed", 3, "--db", self.folder / "s.db",
                             expect=expect)

    def test_a_recorded_hand_runs_a_session(self):
        folder = self.record()
        (folder / "actions.csv").write_text("trial_number,t_s,action,slot,label\n"
                                            "1,5.0,select,2,\n2,6.5,no_difference,,\n")
        self.run_recorded(folder)
        db = self.folder / "s.db"
        self.assertEqual(query(db, "select outcome, level_g, chosen_slot, validated_s - started_s "
                                   "from trial order by trial_id"),
                         [("difference", 600, 2, 5.0), ("no_difference", 500, None, 6.5)])
        pushed = query(db, "select slot, n_pushes from cube join trial using (trial_id) "
                           "where trial_number = 1 order by slot")
        self.assertEqual(pushed, [(1, 1), (2, 0)])
        self.run_heft("replay", "--db", db)

    def test_what_the_screen_does_not_offer_is_refused_and_named(self):
        folder = self.record()
        path = folder / "trial_1.csv"  # a hand that starts on the cubes: they never appear
        path.write_text(path.read_text().replace("-0.13", "0.0"))
        (folder / "actions.csv").write_text("trial_number,t_s,action,slot,label\n1,5.0,select,2,\n")
        done = self.run_recorded(folder, expect=1)
        self.assertIn("the cubes are not shown yet", done.stderr)
        self.assertEqual(query(self.folder / "s.db", "select state from session"), [("paused",)])

    def test_a_recording_that_ends_early_stops_the_session(self):
        folder = self.record()
        (folder / "actions.csv").write_text("trial_number,t_s,action,slot,label\n1,5.0,select,2,\n")
        done = self.run_recorded(folder, expect=1)
        self.assertIn("trial 2", done.stderr)
        self.assertEqual(query(self.folder / "s.db", "select status, void_reason from trial"),
                         [("completed", None), ("void", "interrupted")])


class Replaying(SessionTest):
    """A changed row of a log is found and named."""

    def setUp(self):
        super().setUp()
        self.whole = self.folder / "whole.db"
        self.session(self.whole, seed=11)

    def tampered(self, sql, *expected):
        db = self.folder / "tampered.db"
        shutil.copy(self.whole, db)
        self.assertEqual(self.change_unchecked(db, sql), 1, sql)
        done = self.run_heft("replay", "--db", db, expect=5)
        for word in ("divergence", *expected):
            self.assertIn(word, done.stdout, sql)

    def change_unchecked(self, db, sql):
        import sqlite3
        connection = sqlite3.connect(db)
        try:
            connection.execute("pragma ignore_check_constraints = on")
            with connection:
                return connection.execute(sql).rowcount
        finally:
            connection.close()

    def test_an_untouched_log_is_verified(self):
        self.assertIn("verified", self.run_heft("replay", "--db", self.whole).stdout)

    def test_projected_rows(self):
        one = "(select trial_id from trial where trial_number = {})"
        self.tampered("update trial set outcome = iif(outcome = 'correct', 'incorrect', 'correct') "
                      "where trial_number = 2", "trial 2", "outcome")
        self.tampered("update trial set level_g = level_g + 1 where trial_number = 5", "trial 5",
                      "level_g")
        self.tampered(f"update cube set n_pushes = n_pushes + 1 where slot = 1 and trial_id = "
                      f"{one.format(3)}", "trial 3", "n_pushes")
        self.tampered(f"update cube set mass_g = 201 where mass_g = 200 and trial_id = "
                      f"{one.format(3)}", "trial 3", "mass_g")
        self.tampered("update answer set t_s = t_s + 0.5 where answer_id = 3", "t_s")
        self.tampered("delete from answer where answer_id = 2", "answer")
        self.tampered("update reversal set level_g = level_g + 1 where number = 1", "reversal 1")
        self.tampered("delete from reversal where number = 2", "no such row")
        self.tampered("update estimate set jnd_g = jnd_g + 0.001", "jnd_g")
        self.tampered("update session set seed = seed + 1", "trial")
        self.tampered("update session set state = 'running'", "session.state")

    def test_events(self):
        self.tampered("update event set slot = 3 - slot where event_id = (select max(event_id) from "
                      "event where detail = 'select')", "answer")
        self.tampered("delete from event where event_id = (select min(event_id) from event where "
                      "kind = 'cube_contact')", "cube_contact")
        self.tampered("update event set detail = 'no_difference', slot = null where event_id = "
                      "(select max(event_id) from event where detail = 'select')", "no_difference")

    def test_what_is_only_kept(self):
        self.tampered("update session set participant = 'somebody else'", "header")
        self.tampered("update session set started_utc = '2020-01-01T00:00:00.000Z'", "header")
        self.tampered("update session set run_options = '{}'", "header")
        self.tampered("update session set protocol_text = ''", "protocol")
        self.tampered("update event set detail = 'x' where kind = 'setup'", "session 1: DIVERGED")
        self.tampered("update event set detail = 'nothing happened' where event_id = (select "
                      "min(event_id) from event where kind = 'trial_started')", "digest")

    def test_rows_that_can_not_be(self):
        self.tampered("delete from trial where trial_number = 1", "trial")
        self.tampered("update trial set status = 'x' where trial_number = 1", "status")
        self.tampered("update event set kind = 'x' where event_id = 3", "kind")
        self.tampered("update frame set cube1_x_m = null where cube1_x_m is not null and frame_id = "
                      "(select max(frame_id) from frame)", "cube1")
        self.tampered("update session set state = 'x'", "state")

    def test_pictures(self):
        middle = "frame_id = (select frame_id from frame where contact_slot is not null limit 1)"
        # Digests come first: what was changed is not simulated. See tests/replay/tampered_test.cpp
        # for frames that have a digest but not what the simulator gives.
        for change in ("effector_y_m = effector_y_m + 1e-9", "clone_x_m = clone_x_m + 1e-9",
                       "cube1_z_m = cube1_z_m + 1e-9", "contact_slot = contact_slot % 2 + 1",
                       "effector_vx_m_s = effector_vx_m_s + 1e-9", "trial_t_s = 0"):
            self.tampered(f"update frame set {change} where {middle}", "the frame of", "digest")
        self.tampered(f"update frame set effector_qw = 7 where {middle}", "the frame of",
                      "effector_qw")
        self.tampered(f"delete from frame where {middle}", "the frame of", "digest")
        self.tampered("delete from frame where frame_id = (select max(frame_id) from frame)",
                      "frame")

    def test_an_unfinished_log_is_verified_too(self):
        db = self.folder / "s.db"
        self.kill_under_way(db)
        self.run_heft("replay", "--db", db)

    def test_what_would_have_been(self):
        same = self.run_heft("replay", "--db", self.whole, "--simulator", "boxes").stdout
        self.assertIn("0.0000", same)
        softer = self.run_heft("replay", "--db", self.whole, "--set",
                               "coupling.stiffness_n_per_m=25").stdout
        rows = [line.split() for line in softer.splitlines() if line.strip().startswith("comparison")]
        self.assertGreater(float(rows[0][3]), 1, "half the stiffness, twice the offset: millimeters")
        coin = self.run_heft("replay", "--db", self.whole, "--responder", "coin", "--rerun").stdout
        self.assertIn("would be", coin)
        self.run_heft("replay", "--db", self.whole, "--set", "coupling.stifness=1", expect=3)
        self.run_heft("replay", "--db", self.whole, "--set", "nonsense", expect=2)
        ignored = self.run_heft("replay", "--db", self.whole, "--set", "display_rate_hz=5", expect=2)
        self.assertIn("in the logged trials", ignored.stderr)


if __name__ == "__main__":
    main("__main__")

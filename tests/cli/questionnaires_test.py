"""Questionnaires of a protocol: each participant is asked each one once, also in resumed sessions.

Run: python3 tests/cli/questionnaires_test.py path/to/heft
"""
import shutil

from session_harness import PROTOCOLS, SessionTest, main, query

ASKED = """
[[screens.questionnaire]]
name = "mine"
[[screens.questionnaire]]
name = "borg_cr10"
"""

MINE = """[questionnaire.mine]
title = "{0}"
[[questionnaire.mine.question]]
key = "a"
kind = "likert"
text = "{0}?"
low = "0"
high = "1"
"""


class Questionnaires(SessionTest):
    def setUp(self):
        super().setUp()
        self.db = self.folder / "a.db"
        self.lab = self.folder / "lab"
        self.lab.mkdir()
        (self.lab / "mine.en.toml").write_text(MINE.format("Mine"))

    def protocol(self, name):
        text = (PROTOCOLS / f"{name}.toml").read_text()
        (self.lab / f"{name}.toml").write_text(text + ASKED)
        return self.lab / f"{name}.toml"

    def test_validate_finds_them_beside_the_protocol(self):
        done = self.run_heft("validate", self.protocol("quick"), cwd=self.folder)
        self.assertIn("simulated participants)", done.stdout)
        self.assertNotIn("cannot complete", done.stdout + done.stderr)

    def info(self, session=1):
        return dict(query(self.db, "select key, value from participant_info where session_id = "
                                   f"{session}"))

    def shown(self):
        return query(self.db, "select json_extract(detail, '$.page'), "
                              "json_extract(detail, '$.language') from event "
                              "where kind = 'text_shown' order by event_id")

    def verified(self):
        said = self.run_heft("replay", "--db", self.db)
        self.assertIn("verified", said.stdout + said.stderr)

    def test_models_are_asked_and_it_replays(self):
        self.run_heft("run", self.protocol("quick"), "--participant", "01", "--responder",
                      "simulated", "--seed", 5, "--db", self.db)
        info = self.info()
        self.assertEqual(info.keys(), {"mine.a", "mine.done_s", "mine.answered_by",
                                       "borg_cr10.exertion", "borg_cr10.done_s",
                                       "borg_cr10.answered_by"})
        self.assertEqual(info["mine.answered_by"], "model")
        self.assertIn(info["mine.a"], "1234567")
        self.assertEqual(self.shown(), [("questionnaire_mine", "en"),
                                        ("questionnaire_borg_cr10", "en")])
        self.verified()
        out = self.folder / "out"
        self.run_heft("export", self.db, "--out", out)
        self.assertIn("info_mine.a", (out / "participants.csv").read_text(encoding="utf-8-sig"))

    def test_simulations_are_asked_with_any_number_of_jobs(self):
        answers = []
        for jobs in (1, 2):
            self.db = self.folder / f"{jobs}.db"
            self.run_heft("simulate", self.protocol("quick"), "--participants", 3, "--jobs", jobs,
                          "--seed", 1, "--db", self.db)
            answers.append(query(self.db, "select session_id, key, value from participant_info "
                                          "order by 1, 2"))
        self.assertEqual(answers[0], answers[1])
        self.assertEqual(len(answers[0]), 3 * 6)
        self.assertGreater(len({value for _, _, value in answers[0]}), 4)

    def stopped_early(self):
        """A session that comes to its questionnaires only when it goes on."""
        self.run_heft("run", self.protocol("quick"), "--participant", "01", "--responder",
                      f"scripted:{self.recording()}", "--db", self.db, expect=1)
        self.assertEqual(self.info(), {})

    def recording(self):
        folder = self.folder / "recording"
        folder.mkdir()
        (folder / "actions.csv").write_text("trial_number,t_s,action,slot,label\n")
        (folder / "trial_1.csv").write_text("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,-0.1,0.025,1,0,0,0\n"
                                            "1,0,-0.1,0.025,1,0,0,0\n")
        return folder

    def test_come_with_anything_that_a_session_continues_with(self):
        for again in ([], ["--tracker", "synthetic"], ["--responder", "always_no"],
                      ["--simulator", "bullet-ea"], ["--view", f"video:{self.folder / 'v.avi'}"]):
            with self.subTest(again=again):
                self.stopped_early()
                moved = self.folder / "moved"
                self.lab.rename(moved)  # the log has all that it needs
                words = again if "--responder" in again else ["--responder", "coin", *again]
                self.run_heft("resume", "--db", self.db, *words, cwd=moved)
                self.assertIn("mine.done_s", self.info())
                self.assertEqual([page for page, _ in self.shown()],
                                 ["questionnaire_mine", "questionnaire_borg_cr10"])
                self.verified()
                moved.rename(self.lab)
                self.db.unlink()
                shutil.rmtree(self.folder / "recording")

    def test_come_in_the_language_that_the_session_continues_in(self):
        self.stopped_early()
        words = ("resume", "--db", self.db, "--responder", "coin", "--language", "fr")
        said = self.run_heft(*words, expect=2).stderr
        self.assertIn(f"{self.lab}/mine.fr.toml", said)  # there is no French one
        (self.lab / "mine.fr.toml").write_text(MINE.format("Le mien"))
        said = self.run_heft(*words).stderr
        self.assertIn("language fr instead of en", said)
        self.assertEqual(self.shown(), [("questionnaire_mine", "fr"),
                                        ("questionnaire_borg_cr10", "fr")])
        self.verified()


if __name__ == "__main__":
    main(__name__)

"""A real object as the reference of a comparison, from end to end: validate, simulate, replay, export, analyse.

Run: python3 tests/cli/analysis/real_reference_test.py PATH_TO_HEFT
"""
import csv
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main, query

EXAMPLE = PROTOCOLS / "examples/real_reference.toml"


class RealReference(SessionTest):
    def test_example_is_simulated_replayed_exported_and_analysed(self):
        said = self.run_heft("validate", EXAMPLE).stdout
        self.assertIn(": ok,", said)
        self.assertIn("comparison 15 s", said)
        db = self.folder / "s.db"
        self.run_heft("simulate", EXAMPLE, "--participants", 6, "--seed", 4, "--db", db)
        self.run_heft("replay", "--db", db)  # fails where a row differs

        trials = query(db, "select trial_id, reference_g, level_g, reference_slot, chosen_slot, "
                           "choice_correct, shown_s from trial where status = 'completed'")
        self.assertEqual(len(trials), 6 * 32)
        for trial, reference, level, reference_slot, chosen, correct, shown in trials:
            self.assertEqual((reference, reference_slot), (200, 2))
            self.assertEqual(query(db, f"select slot, mass_g from cube where trial_id = {trial}"),
                             [(1, 200 + level)], "one cube: the object has no physics")
            answers = query(db, "select action, t_s from answer where trial_id = "
                                f"{trial} order by answer_id")
            self.assertEqual([row[0] for row in answers],
                             ["lifted", "select" if chosen == 1 else "select_object"])
            self.assertLess(shown, answers[0][1])
            self.assertLess(answers[0][1], answers[1][1])
            self.assertEqual(correct, None if level == 0 else (chosen == 1) == (level > 0))

        found = json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)
        chosen = {row["at"]: row["value"] for row in found["estimates"]
                  if row["measure"] == "forced_chosen" and not row["participant"]}
        self.assertLess(chosen["level_g=-150"], 15)
        self.assertGreater(chosen["level_g=200"], 85)
        self.assertTrue(all(row["published"] in (None, "") for row in found["estimates"]),
                        "the paper's reference was a cube")
        self.run_heft("export", db, "--out", self.folder / "data")
        with open(self.folder / "data/trials.csv", newline="", encoding="utf-8") as lines:
            self.assertEqual({row["reference_slot"] for row in csv.DictReader(lines)}, {"2"})

    def test_report_names_the_object(self):
        db = self.folder / "s.db"
        self.run_heft("run", EXAMPLE, "--participant", "01", "--responder", "simulated", "--seed", 4,
                      "--db", db, "--language", "fr")
        self.run_heft("replay", "--db", db)
        self.run_heft("analyse", "--db", db, "--out", self.folder / "report")
        page = (self.folder / "report/report.html").read_text(encoding="utf-8")
        self.assertIn("They lifted a real object (brass cylinder, 200 g)", page)

    def test_three_answers_feed_a_staircase(self):
        text = EXAMPLE.read_text(encoding="utf-8").replace('answers = "heavier"', "")
        text = re.sub(r"kind = \"constant\".*", "start = 200\nstep = 50\nfloor = 0\nstop_reversals = 6\n"
                      "stop_trials = 30\n", text, flags=re.S)
        protocol, db = self.folder / "p.toml", self.folder / "s.db"
        protocol.write_text(text, encoding="utf-8")
        self.run_heft("simulate", protocol, "--participants", 3, "--seed", 4, "--db", db)
        self.run_heft("replay", "--db", db)
        jnds = json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)["jnd"]
        self.assertEqual([(row["reference_g"], row["condition"]) for row in jnds], [(200, "C2")])
        self.assertEqual(len(query(db, "select * from v_jnd where reference_g = 200")), 3)


if __name__ == "__main__":
    main("__main__")

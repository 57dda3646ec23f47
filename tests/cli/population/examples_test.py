"""Each example protocol is validated, simulated, replayed, analysed and exported; together the examples show
every task, answer set and procedure.

Run: python3 tests/cli/population/examples_test.py PATH_TO_HEFT
"""
import csv
import json
import re
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main, query

EXAMPLES = sorted((PROTOCOLS / "examples").glob("*.toml"))
OTHER_FILES = {"STUDY", "paper_figures", "population"}  # a plan, reported figures, parameters of people
WITHOUT_TRIALS = {"demonstration", "break"}
PRACTICE = {"practice", "modulus"}  # keys that put practice trials first


def read(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def values_in(blocks, key, default):
    return {block.get(key, default) for block in blocks}


class Examples(SessionTest):
    protocols = [path for path in EXAMPLES if "block" in read(path)]
    blocks = [block for path in protocols for block in read(path)["block"]]

    def words_of(self, line):
        """What the program expects instead of an unknown word in a protocol."""
        path = self.folder / "unknown.toml"
        path.write_text(f'title = "t"\n[[block]]\nname = "b"\n{line}\n', encoding="utf-8")
        said = self.run_heft("validate", path, expect=3)
        expected = re.search(r"expected (.*?)(;|\n)", said.stdout + said.stderr).group(1)
        return set(re.findall(r'"(\w+)"', expected))

    def test_they_show_every_task_answer_set_and_procedure(self):
        self.assertEqual({path.stem for path in EXAMPLES} - OTHER_FILES,
                         {path.stem for path in self.protocols})
        tasks = self.words_of('kind = "unknown"') - WITHOUT_TRIALS
        self.assertIn("sorting", tasks)
        alone = [{block["kind"] for block in read(path)["block"]} - WITHOUT_TRIALS - {"introduction"}
                 for path in self.protocols]
        for task in tasks - {"introduction"}:
            self.assertIn({task}, alone, "no file for this one")

        comparisons = [block for block in self.blocks if block["kind"] == "comparison"]
        answers = self.words_of('kind = "comparison"\nanswers = "unknown"')
        self.assertIn("heavier", answers)
        self.assertEqual(answers - values_in(comparisons, "answers", "heavier_or_none"), set())

        staircases = [staircase for block in self.blocks for staircase in block.get("staircase", [])]
        kinds = set(re.findall(r'kind = "(\w+)"',
                               self.run_heft("procedure", "--help-all").stdout))
        self.assertIn("up_down", kinds)
        self.assertEqual(kinds - values_in(staircases, "kind", "up_down"), set())

    def test_each_is_simulated_replayed_analysed_and_exported(self):
        for path in self.protocols:
            with self.subTest(path.name):
                said = self.run_heft("validate", path).stdout
                self.assertIn(": ok, a protocol", said)
                db, out = self.folder / f"{path.stem}.db", self.folder / path.stem
                self.run_heft("simulate", path, "--participants", 1, "--seed", 3, "--db", db)
                self.run_heft("replay", "--db", db)  # fails where a row differs
                found = json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)
                self.run_heft("export", "--db", db, "--out", out)

                completed = query(db, "select block, task, is_practice from trial"
                                      " where status = 'completed' order by trial_id")
                self.expect_planned(said, len(completed))
                blocks = [block for block in read(path)["block"]
                          if block["kind"] not in WITHOUT_TRIALS]
                self.assertEqual({(block["name"], block["kind"]) for block in blocks},
                                 {(block, task) for block, task, _ in completed})
                self.assertEqual({block["name"] for block in blocks if block.keys() & PRACTICE},
                                 {block for block, _, is_practice in completed if is_practice})
                estimated = {row["task"] for row in found["estimates"] if row["n_trials"]}
                self.assertLessEqual({block["kind"] for block in blocks}, estimated)
                with open(out / "trials.csv", encoding="utf-8", newline="") as file:
                    exported = [row for row in csv.DictReader(file)
                                if row["status"] == "completed"]
                self.assertEqual([(row["block"], row["task"], int(row["is_practice"]))
                                  for row in exported], completed)

    def expect_planned(self, said, n_completed):
        """As many trials as `validate` expects, or about as many where that depends on answers."""
        expected = int(re.search(r"about (\d+) trials", said).group(1))
        if re.search(r"about \d+ trials \(", said):
            self.assertLess(abs(n_completed - expected), 0.5 * expected)
        else:
            self.assertEqual(n_completed, expected)


if __name__ == "__main__":
    main("__main__")

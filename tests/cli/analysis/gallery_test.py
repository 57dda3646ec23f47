"""Published experiments as protocols: each is simulated, replayed and analysed, and its comments
state what it reproduces, what it leaves out and what was checked.

Run: python3 tests/cli/analysis/gallery_test.py PATH_TO_HEFT
"""
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main, query

GALLERY = sorted((PROTOCOLS / "examples/gallery").glob("*.toml"))
# Required in the comments above the first key.
SAID = ("After:", "Reproduces:", "Leaves out:", "hecked against")


class Gallery(SessionTest):
    def analysed(self, protocol, participants, responder="simulated"):
        db = self.folder / f"{protocol.stem}.db"
        self.run_heft("simulate", protocol, "--participants", participants, "--seed", 2, "--frames",
                      "--responder", responder, "--db", db)
        self.run_heft("replay", "--db", db)  # fails where a row differs
        return json.loads(self.run_heft("analyse", "--db", db, "--json").stdout), db

    def test_each_says_what_it_is(self):
        self.assertGreaterEqual(len(GALLERY), 5)
        table = (PROTOCOLS / "examples/gallery/README.md").read_text(encoding="utf-8")
        for path in GALLERY:
            text = path.read_text(encoding="utf-8")
            head = text[:text.index("title =")]
            for words in SAID:
                self.assertIn(words, head, path.name)
            self.assertIn(f"({path.name})", table)
            self.assertIn(": ok,", self.run_heft("validate", path).stdout, path.name)

    def test_each_is_simulated_replayed_and_analysed(self):
        for path in GALLERY:
            with self.subTest(path.name):
                found, db = self.analysed(path, participants=2)
                n = query(db, "select count(*) from trial where status = 'completed'")[0][0]
                planned = int(re.search(r"about (\d+) trials",
                                        self.run_heft("validate", path).stdout).group(1))
                self.assertEqual(n, 2 * planned)
                self.assertTrue(found["estimates"])

    def test_less_movement_seems_heavier(self):
        """Dominjon et al.'s result, by people whose cue is the ratio, which shows no gain above 1."""
        folder = PROTOCOLS / "examples/gallery"
        found, _ = self.analysed(folder / "dominjon_2005.toml", participants=6,
                                 responder=f"simulated:{folder / 'people/ratio.toml'}")
        chosen = {row["at"]: row["value"] for row in found["estimates"]
                  if row["measure"] == "forced_chosen" and not row["participant"]}
        self.assertLess(chosen["level_g=-100"], 65)
        for level_g in 25, 50, 100:
            self.assertGreater(chosen[f"level_g={level_g}"], 85)


if __name__ == "__main__":
    main("__main__")

"""Simulations in shards, killed at random moments and run again, and a merge that is killed, too: the
merged log is that of one run, row for row. Refusals, help and completion. HEFT_SEED repeats a
failure.

Run: python3 tests/cli/cluster/shards_test.py PATH_TO_HEFT [-v]
"""
import json
import os
import random
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from session_harness import PROTOCOLS, SessionTest, change, main, query, rows_of

QUICK = PROTOCOLS / "quick.toml"
SEED = int(os.environ.get("HEFT_SEED", random.randrange(10**6)))


class Shards(SessionTest):
    def words(self, participants, *more, seed=9, protocol=QUICK):
        return ["simulate", protocol, "--participants", participants, "--seed", seed, *more]

    def shard(self, number, of, participants, *more, expect=0, seed=9, db=None):
        return self.run_heft(*self.words(participants, "--shard", f"{number}/{of}", "--db",
                                         db or self.folder / f"{number}.db", *more, seed=seed),
                             expect=expect)

    def one_run(self, participants, seed=9):
        db = self.folder / "one.db"
        self.run_heft(*self.words(participants, "--db", db, seed=seed))
        return db

    def killed(self, seconds, *words):
        """Starts heft and kills it, unless it ends before."""
        process = subprocess.Popen([self.heft, *map(str, words)], stderr=subprocess.DEVNULL)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


class KilledAndRequeued(Shards):
    def test_the_merged_log_is_that_of_one_run(self):
        print(f"HEFT_SEED={SEED}", file=sys.stderr)
        for n in range(3):
            with self.subTest(seed=SEED, n=n):
                self.check(random.Random(f"{SEED} {n}"), self.folder / str(n))

    def check(self, chance, folder):
        folder.mkdir()
        self.folder = folder
        of, seed, jobs = chance.randint(1, 5), chance.randrange(2**63), chance.choice((1, 2, 3))
        participants = chance.randint(of, 3 * of + 5)
        shards = [folder / f"{number}.db" for number in range(1, of + 1)]
        for number, db in enumerate(shards, 1):
            words = self.words(participants, "--shard", f"{number}/{of}", "--jobs", jobs, "--db", db,
                               seed=seed)
            for _ in range(chance.randint(0, 3)):
                self.killed(0.6 * chance.random(), *words)
            self.run_heft(*words)
            before = db.read_bytes()
            self.assertIn("0 participants in", self.run_heft(*words).stderr)
            self.assertEqual(query(db, "select count(distinct participant) from session"),
                             query(db, "select count(*) from session"))
            self.assertTrue(db.read_bytes() == before)
        merged = folder / "all.db"
        for _ in range(3):
            chance.shuffle(shards)
            self.killed(0.6 * chance.random(), "merge", merged, *shards)
        self.run_heft("merge", merged, *shards)
        one = self.one_run(participants, seed)
        self.assertEqual(query(merged, "select head from seal"), query(one, "select head from seal"))
        self.assertTrue(rows_of(merged) == rows_of(one))
        before = merged.read_bytes()
        self.assertIn("0 of them new", self.run_heft("merge", merged, *shards).stderr)
        self.assertTrue(merged.read_bytes() == before)
        self.run_heft("replay", "--db", merged)

    def test_a_stopped_shard_says_how_to_continue(self):
        db = self.folder / "1.db"
        words = self.words(500, "--shard", "1/2", "--db", db)
        process = subprocess.Popen([self.heft, *map(str, words)], stderr=subprocess.PIPE, text=True)
        while not db.exists() or self.n_sessions(db) == 0:
            time.sleep(0.02)
        process.terminate()  # as Slurm does before it kills
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("the same command continues", said)
        n = self.n_sessions(db)
        self.assertEqual(query(db, "select participant from session order by session_id"),
                         [(f"sim-{2 * place + 1:04}",) for place in range(n)])

    @staticmethod
    def n_sessions(db):
        try:
            return query(db, "select count(*) from session")[0][0]
        except Exception:  # it is being made
            return 0

    def test_analyses_of_both_logs_are_the_same(self):
        for number in (1, 2):
            self.shard(number, 2, 5)
        merged = self.folder / "all.db"
        self.run_heft("merge", merged, self.folder / "1.db", self.folder / "2.db")
        one = self.one_run(5)
        summaries = [json.loads(self.run_heft("analyse", "--db", db, "--json").stdout)
                     for db in (merged, one)]
        for summary in summaries:
            summary.pop("databases", None)
        texts = [json.dumps(summary).replace(str(db), "") for summary, db in zip(summaries, (merged, one))]
        self.assertEqual(texts[0], texts[1])


class Refused(Shards):
    def merge_fails(self, *shards, code=2):
        merged = self.folder / "all.db"
        said = self.run_heft("merge", merged, *shards, expect=code).stderr
        self.assertFalse(merged.exists())
        self.assertIn("nothing was merged", said)
        return said

    def test_options_that_make_no_shard(self):
        for text in ("0/3", "4/3", "3", "1/", "/3", "1/3x", "-1/3", "1/0", "a/b", " 1/3"):
            said = self.run_heft(*self.words(3, f"--shard={text}"), expect=2).stderr
            self.assertIn("expected I/N", said)
        said = self.run_heft("simulate", QUICK, "--shard", "1/2", expect=2).stderr
        self.assertIn("--shard needs --seed", said)

    def test_shards_that_do_not_fit(self):
        one, two = self.folder / "1.db", self.folder / "2.db"
        self.shard(1, 2, 4)
        self.assertIn("run shard 2/2 again", self.merge_fails(one).lower())
        self.shard(2, 2, 4, seed=10)
        self.assertIn("--seed 10, not 9", self.merge_fails(one, two))
        two.unlink()
        self.shard(2, 2, 5)
        self.assertIn("--participants 5, not 4", self.merge_fails(one, two))
        two.unlink()
        self.shard(2, 2, 4, "--set", "coupling.stiffness_n_per_m=100")
        self.assertIn("settings", self.merge_fails(one, two))
        other = self.folder / "other.toml"
        shutil.copy(QUICK, other)
        self.run_heft(*self.words(4, "--shard", "2/2", "--db", self.folder / "o.db", protocol=other))
        self.assertIn('protocol', self.merge_fails(one, self.folder / "o.db"))
        self.assertIn("no file", self.run_heft("merge", self.folder / "all.db", one,
                                               self.folder / "none.db", expect=1).stderr)

    def test_a_shard_that_was_changed(self):
        self.shard(1, 2, 2)
        self.shard(2, 2, 2)
        change(self.folder / "2.db", "update trial set outcome = null where trial_number = 1")
        said = self.merge_fails(self.folder / "1.db", self.folder / "2.db", code=5)
        self.assertIn("2.db was changed or damaged", said)

    def test_logs_of_other_sessions(self):
        self.session(self.folder / "person.db")
        self.assertIn("heft simulate --shard", self.merge_fails(self.folder / "person.db"))
        (self.folder / "empty.db").touch()
        self.assertIn("no participants", self.merge_fails(self.folder / "empty.db"))
        before = (self.folder / "person.db").read_bytes()
        self.assertIn("Choose another file", self.shard(1, 2, 4, db=self.folder / "person.db",
                                                        expect=2).stderr)
        self.assertTrue((self.folder / "person.db").read_bytes() == before)


class Known(Shards):
    def test_help_says_what_to_run(self):
        text = " ".join(self.run_heft("simulate", "--help-all").stdout.split())
        self.assertRegex(text, r"--shard \S+ I/N: only participants I, I \+ N")
        self.assertIn("heft merge", text)
        self.assertIn("heft merge all.db shard-*.db", self.run_heft("merge", "--help").stdout)
        self.assertRegex(self.run_heft("--help").stdout, r"(?m)^  merge +join the shards")

    def test_completions_offer_them(self):
        for shell in ("bash", "zsh", "fish"):
            script = self.run_heft("completion", shell).stdout
            self.assertRegex(script, r"\bmerge\b")
            self.assertRegex(script, r"(--shard\b|-l shard )")


if __name__ == "__main__":
    main("__main__")

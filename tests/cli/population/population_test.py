"""Simulated participants of a population file: logged draws, resumed sessions, refusals.

Run: python3 tests/cli/population/population_test.py PATH_TO_HEFT
"""
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from session_harness import PROTOCOLS, SessionTest, main, outcome_of, query

DRAWN = "select name, value from participant_parameter order by name, value"


class Population(SessionTest):
    def population(self, extra=""):
        file = self.folder / "people.toml"
        text = (PROTOCOLS / "examples/population.toml").read_text(encoding="utf-8")
        file.write_text(text + extra, encoding="utf-8")
        return file

    def test_a_killed_session_resumes_with_the_same_person_without_the_file(self):
        file = self.population()
        whole, killed = self.folder / "whole.db", self.folder / "killed.db"
        words = ["run", PROTOCOLS / "quick.toml", "--participant", "01", "--responder",
                 f"population:{file}", "--seed", 5, "--db"]
        self.run_heft(*words, whole)
        process = subprocess.Popen([self.heft, *map(str, words), killed],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None:
            if killed.exists() and self.n_events(killed) > 5:
                process.send_signal(signal.SIGKILL)
                break
            time.sleep(0.002)
        process.communicate()
        self.assertEqual(process.returncode, -signal.SIGKILL, "it ended before it was killed")
        file.unlink()
        self.run_heft("resume", "--db", killed)
        self.assertEqual(outcome_of(killed), outcome_of(whole))
        self.assertEqual(set(query(killed, DRAWN)), set(query(whole, DRAWN)))
        self.assertTrue(query(whole, DRAWN))

    def n_events(self, db):
        try:
            return query(db, "select count(*) from event")[0][0]
        except Exception:  # the file is still being made
            return 0

    def test_people_do_not_depend_on_the_number_of_threads(self):
        drawn = []
        for jobs in (1, 2):
            db = self.folder / f"{jobs}.db"
            self.run_heft("simulate", PROTOCOLS / "quick.toml", "--responder",
                          f"population:{self.population()}", "--participants", 4, "--seed", 3,
                          "--jobs", jobs, "--db", db)
            drawn.append(query(db, DRAWN))
        self.assertEqual(drawn[0], drawn[1])
        criteria = {value for name, value in drawn[0] if name == "criterion_mm"}
        self.assertEqual(len(criteria), 4)

    def test_mistakes_are_refused_at_their_place(self):
        said = self.run_heft("simulate", PROTOCOLS / "quick.toml", "--responder",
                             f"population:{self.population('hold = 0.1')}", "--db",
                             self.folder / "no.db", expect=3).stderr
        self.assertRegex(said, r"people\.toml:\d+:\d+: unknown parameter \"hold\"")


if __name__ == "__main__":
    main("__main__")

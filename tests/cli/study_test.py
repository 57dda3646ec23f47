"""Studies: the place, group and order of the next participant, what the log records of it, backups,
and events for other recorders.

Run: python3 tests/cli/study_test.py path/to/heft
"""
import csv
import json
import os
import pty
import signal
import socket
import subprocess
import threading
import time
from datetime import datetime

from session_harness import PROTOCOLS, SessionTest, main, query

STUDY = f"""
study = "mass"
participants = 4
seed = 1
id_prefix = "P"
db = "logs/mass.db"
backup = "copies"

[order]
design = "latin"
blocks = ["sorting", "comparison"]

[[group]]
name = "first"
protocol = "{PROTOCOLS / 'quick.toml'}"

[[group]]
name = "second"
protocol = "again.toml"
language = "fr"
"""


# Short for a participant who perceives differences, long for one who never does.
LONG = """title = "Long"
display_rate_hz = 15
[[block]]
kind = "comparison"
name = "comparison"
technique = "C2"
catch_fraction = 0
positive_answer = "any_choice"
interleave = "random"
[[block.staircase]]
name = "200g"
reference_g = 200
start = 600
step = 300
halve_every = 1
floor = 0
ceiling = 1500
change_step = "before_move"
stop_reversals = 3
stop_trials = 100
discard_reversals = 1
"""


class StudyTest(SessionTest):
    def setUp(self):
        super().setUp()
        self.plan = self.folder / "STUDY.toml"
        self.db = self.folder / "logs" / "mass.db"
        self.db.parent.mkdir()
        (self.folder / "again.toml").write_text((PROTOCOLS / "quick.toml").read_text())
        self.plan.write_text(STUDY)

    def next(self, *words, **options):
        return self.run_heft("run", "--plan", self.plan, "--responder", "simulated", "--seed", 5,
                             *words, **options)

    def info(self, session):
        return dict(query(self.db, "select key, value from participant_info where session_id = "
                                   f"{session}"))


class Plans(StudyTest):
    def test_each_participant_gets_the_next_place(self):
        for number in range(1, 5):
            said = self.next().stderr
            self.assertIn(f"participant simulated-P0{number} of the study mass: {number} of 4", said)
        cells = {(self.info(i)["study_group"], self.info(i)["study_order"]) for i in range(1, 5)}
        self.assertEqual(len(cells), 4, cells)
        for session, protocol in query(self.db, "select session_id, protocol_name from session"):
            group = self.info(session)["study_group"]
            self.assertEqual(protocol, "quick" if group == "first" else "again")
            shown = [block for block, in query(
                self.db, f"select distinct block from trial where session_id = {session} "
                         "order by trial_id")]
            self.assertEqual(shown[0], "introduction")
            self.assertEqual(", ".join(shown[1:]), self.info(session)["study_order"])
        said = self.next(expect=1).stderr
        self.assertIn("all 4 participants", said)

    def test_a_participant_can_be_named(self):
        self.next("--participant", "P03")
        self.assertEqual(self.info(1)["study_place"], "3")
        said = self.next("--participant", "Anna", expect=2).stderr
        self.assertIn('has no participant "Anna", but P01 to P04', said)
        self.next("--participant", "Anna", "--again")
        self.assertEqual(self.info(2)["study_place"], "1")
        self.assertIn("--again", self.next("--participant", "Anna", expect=2).stderr)
        self.next("--participant", "Anna", "--again")
        self.assertEqual(self.info(3)["study_place"], "1")
        self.assertIn("P02", self.next().stderr)

    def test_its_sessions_continue_and_replay(self):
        self.next()
        self.next()
        for session in (1, 2):
            said = self.run_heft("replay", "--db", self.db, "--session", session)
            self.assertIn("verified", said.stdout + said.stderr)

    def test_one_that_was_killed_continues_in_its_order(self):
        self.next()  # uninterrupted, for comparison
        whole = self.folder / "logs" / "whole.db"
        self.db.rename(whole)
        process = subprocess.Popen([self.heft, "run", "--plan", self.plan, "--responder",
                                    "simulated", "--seed", "5"], stderr=subprocess.DEVNULL)
        while process.poll() is None and not self.is_under_way(self.db):
            time.sleep(0.005)
        process.kill()
        process.wait()
        if query(self.db, "select state from session") == [("finished",)]:
            self.skipTest("it was over before it could be killed")
        said = self.next("--participant", "P01", expect=2).stderr
        self.assertIn("heft resume", said)
        before = len(list((self.folder / "copies").iterdir()))
        self.run_heft("resume", "--db", self.db)
        trials = "select trial_number, block, outcome from trial where status = 'completed'"
        self.assertEqual(query(self.db, trials), query(whole, trials))
        said = self.run_heft("replay", "--db", self.db)
        self.assertIn("verified", said.stdout + said.stderr)
        self.assertEqual(len(list((self.folder / "copies").iterdir())), before + 1)

    def test_a_plan_that_was_changed_on_the_way_is_refused(self):
        self.next()
        self.plan.write_text(STUDY.replace('"first"', '"other"').replace('"second"', '"more"'))
        self.assertIn("session 1 of participant simulated-P01 has place 1", self.next(expect=1).stderr)
        self.plan.write_text(STUDY.replace("participants = 4", "participants = 8"))
        self.assertIn("2 of 8", self.next().stderr)

    def test_a_protocol_that_was_changed_on_the_way_is_reported(self):
        for _ in range(4):
            self.next()
        self.plan.write_text(STUDY.replace("participants = 4", "participants = 12"))
        had = [participant for participant, in query(
            self.db, "select participant from session where protocol_name = 'again'")]
        changed = self.folder / "again.toml"
        changed.write_text(changed.read_text() + "# more words\n")
        said = ""
        for number in range(5, 9):  # two of each group
            done = self.next("--participant", f"P{number:02}", expect=None)
            if done.returncode:
                self.assertEqual(done.returncode, 2, done.stderr)
                said = done.stderr
                for word in (changed, *had, '"second"', "--changed-protocol"):
                    self.assertIn(str(word), said)
                done = self.next("--participant", f"P{number:02}", "--changed-protocol")
                self.assertIn(f"WARNING: {changed} is not what", done.stderr)
                break
        self.assertTrue(said, "nothing was told")
        n = 0
        for number in range(9, 13):  # confirmed once, then warned
            done = self.next("--participant", f"P{number:02}")
            n += "WARNING" in done.stderr
        self.assertEqual(n, 2)

    def test_validate_shows_the_orders(self):
        said = self.run_heft("validate", self.plan).stdout
        self.assertIn("ok, a study plan", said)
        self.assertEqual(said.count("   1 with group"), 4)
        self.assertIn("sorting, comparison", said)
        self.assertIn("comparison, sorting", said)
        self.plan.write_text(STUDY.replace("participants = 4", "participants = 5"))
        self.assertIn("expected 4 or 8", self.run_heft("validate", self.plan).stderr)

    def test_validate_sees_what_people_would_miss(self):
        asked = (PROTOCOLS / "quick.toml").read_text()
        (self.folder / "mine.en.toml").write_text(
            '[questionnaire.mine]\ntitle = "T"\n[[questionnaire.mine.question]]\nkey = "a"\n'
            'kind = "text"\ntext = "A?"\n')
        (self.folder / "again.toml").write_text(
            asked + '\n[[screens.questionnaire]]\nname = "mine"\n')
        said = self.run_heft("validate", self.plan, expect=3).stderr
        self.assertIn("mine.fr.toml", said)  # there is no French one
        self.run_heft("validate", self.folder / "again.toml")
        self.plan.write_text(STUDY.replace('"fr"', '"xx"'))
        self.assertIn('"xx"', self.run_heft("validate", self.plan, expect=3).stderr)

    def test_two_questionnaires_of_one_name_are_refused(self):
        question = '[[questionnaire.{}.question]]\nkey = "a"\nkind = "text"\ntext = "A?"\n'
        for file, names in (("one", ("one", "two")), ("two", ("two",))):
            (self.folder / f"{file}.en.toml").write_text("".join(
                f'[questionnaire.{name}]\ntitle = "T"\n' + question.format(name)
                for name in names))
        protocol = self.folder / "again.toml"
        for order in (("one", "two"), ("two", "one")):
            protocol.write_text((PROTOCOLS / "quick.toml").read_text() + "".join(
                f'\n[[screens.questionnaire]]\nname = "{name}"\n' for name in order))
            for words in (["validate", protocol],
                          ["run", protocol, "--participant", "1", "--tracker", "mouse"]):
                said = self.run_heft(*words, expect=3).stderr
                self.assertIn("one.en.toml and ", said.replace("two.en.toml and", "one.en.toml and"))
                self.assertIn("both have a [questionnaire.two]", said)

    def test_no_one_takes_anothers_place_by_a_slip(self):
        for near in ("P2", "p2", "2", "02"):
            said = self.next("--participant", near, expect=2).stderr
            self.assertIn(f'has no participant "{near}", but there is "P02"', said)
            self.assertIn("--again", said)
        self.assertFalse(self.db.exists())
        self.next("--participant", "P2", "--again")
        said = self.next("--set", 'block_order=["sorting", "comparison"]', expect=2).stderr
        self.assertIn("block_order", said)

    def test_pseudonyms_keep_the_group_and_not_the_place(self):
        self.next()
        out = self.folder / "out"
        self.run_heft("export", self.db, "--pseudonymise", "--out", out)
        with open(out / "participants.csv", encoding="utf-8-sig") as file:
            row = next(csv.DictReader(file))
        self.assertIn(row["info_study_group"], ("first", "second"))
        self.assertIn("sorting", row["info_study_order"])
        self.assertFalse({"info_study_place", "info_study", "info_study_backup"} & row.keys())

    def test_mistakes_are_reported_at_their_places(self):
        self.plan.write_text(STUDY.replace('"comparison"]', '"comparisons"]'))
        for words in (["validate", self.plan], ["run", "--plan", self.plan]):
            said = self.run_heft(*words, expect=3).stderr
            self.assertIn(f"{self.plan}:11:22: ", said)
            self.assertIn('"comparison"', said)
        self.assertFalse(self.db.exists())
        self.assertIn("expected no other one",
                      self.run_heft("run", PROTOCOLS / "quick.toml", "--plan", self.plan,
                                    expect=2).stderr)

    def test_a_plan_is_no_protocol_and_says_what_it_is(self):
        said = self.run_heft("run", self.plan, "--participant", "1", expect=2).stderr
        self.assertIn(f"{self.plan} is a study plan: heft run --plan {self.plan}", said)
        protocol = self.folder / "again.toml"
        said = self.run_heft("run", "--plan", protocol, expect=2).stderr
        self.assertIn(f"heft run {protocol} --participant ID", said)
        self.assertEqual(len(said.splitlines()), 1)

    def test_analyse_takes_orders_for_one_protocol(self):
        self.next()
        self.next()
        said = self.run_heft("analyse", "--db", self.db, "--tables").stdout
        self.assertNotIn("with --set", said)


class NearIds(StudyTest):
    def test_are_asked_about(self):
        db = self.folder / "a.db"
        self.session(db, participant="01")
        for near in ("1", " 01", "O1"):
            said = self.session(db, participant=near, expect=2).stderr
            self.assertIn('there is "01"', said)
            self.assertIn("--again", said)
        self.session(db, participant="02")
        self.session(db, "--again", participant="1")
        self.assertEqual(len(query(db, "select * from session")), 3)

    def answered(self, answer):
        db = self.folder / "a.db"
        self.session(db, participant="01")
        there, here = pty.openpty()
        process = subprocess.Popen(
            [self.heft, "run", PROTOCOLS / "quick.toml", "--participant", "1", "--responder",
             "simulated", "--db", db], stdin=here, stderr=here, stdout=subprocess.DEVNULL)
        os.close(here)
        os.write(there, answer)
        try:
            while os.read(there, 4096):
                pass
        except OSError:
            pass
        return process.wait(), len(query(db, "select * from session"))

    def test_a_terminal_is_asked(self):
        self.assertEqual(self.answered(b"n\n"), (2, 1))
        (self.folder / "a.db").unlink()
        self.assertEqual(self.answered(b"what\ny\n"), (0, 2))


class ListAndShow(StudyTest):
    def test_show_who_what_and_how_far(self):
        self.next()
        self.next()
        self.session(self.db, "--purpose", "pilot", protocol="sorting", participant="X 9")
        said = self.run_heft("list", "--db", self.db)
        lines = said.stdout.splitlines()
        self.assertEqual(len(lines), 5)
        self.assertEqual(lines[0], "all: purpose simulated, state finished")
        self.assertTrue(lines[1].startswith("session"))
        self.assertIn("mass 2 of 4", lines[3])
        self.assertIn("X 9", lines[4])
        self.assertIn(f"heft analyse --db {self.db}", said.stderr)
        rows = json.loads(self.run_heft("list", "--db", self.db, "--json").stdout)
        self.assertEqual([row["participant"] for row in rows], ["simulated-P01", "simulated-P02", "X 9"])
        self.assertEqual(rows[1]["study"]["place"], 2)
        self.assertIsNone(rows[2]["study"])
        self.assertEqual(rows[0]["n_completed"], query(
            self.db, "select count(*) from trial where session_id = 1 and "
                     "status = 'completed'")[0][0])

    def test_an_unfinished_one_says_how_to_continue(self):
        db = self.folder / "it's.db"
        self.kill_under_way(db)
        said = self.run_heft("list", "--db", db)
        self.assertRegex(said.stdout, r"\d+ of about \d+")
        self.assertIn("heft resume --db '", said.stderr)
        said = self.run_heft("show", "--db", db)
        self.assertIn("session 1: participant 01", said.stdout)
        self.assertIn("trials by block", said.stdout)
        self.assertIn("--session 1", said.stderr)
        shown = json.loads(self.run_heft("show", "--db", db, "--json").stdout)
        self.assertEqual(shown["setups"][0]["responder"], "simulated")
        self.assertEqual(shown["state"], "running")

    def test_an_estimate_below_what_was_done_is_not_printed(self):
        recording = self.folder / "recording"
        recording.mkdir()
        n_trials = 40
        for number in range(1, n_trials + 1):
            (recording / f"trial_{number}.csv").write_text(
                "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,-0.1,0.025,1,0,0,0\n10,0,-0.1,0.025,1,0,0,0\n")
        (recording / "actions.csv").write_text("trial_number,t_s,action,slot,label\n" + "".join(
            f"{number},1.5,no_difference,,\n" for number in range(1, n_trials + 1)))
        protocol = self.folder / "long.toml"
        protocol.write_text(LONG)
        self.assertRegex(self.run_heft("validate", protocol).stdout, r"about (\d|1\d|2\d) trials")
        db = self.folder / "long.db"
        self.run_heft("run", protocol, "--participant", "1", "--responder", f"scripted:{recording}",
                      "--db", db, expect=1)
        said = self.run_heft("list", "--db", db).stdout
        self.assertRegex(said, r"\b40\b")
        self.assertNotIn("of about", said)

    def test_show_has_nothing_of_masses(self):
        self.next()
        said = self.run_heft("show", "--db", self.db).stdout
        self.assertIn("study mass: 1 of 4", said)
        self.assertNotRegex(said, r"\d+ ?g\b")

    def test_show_has_what_a_session_was_run_with(self):
        self.next("--set", "coupling.stiffness_n_per_m=80", "--simulator", "bullet")
        said = self.run_heft("show", "--db", self.db).stdout
        self.assertRegex(said, r"simulator bullet at \d+ Hz, view headless at \d+ Hz, input path")
        self.assertIn(", set coupling.stiffness_n_per_m=80", said)

    def test_logs_that_are_none_are_refused(self):
        self.assertIn("there is no file", self.run_heft("list", "--db", self.folder / "no.db",
                                                        expect=1).stderr)
        self.session(self.folder / "a.db")
        self.assertIn("has no session 7", self.run_heft("show", "--db", self.folder / "a.db",
                                                          "--session", 7, expect=1).stderr)


class Backups(StudyTest):
    def copies(self, folder="copies"):
        return sorted((self.folder / folder).glob("*"))

    def test_are_whole_logs_for_their_owner(self):
        said = self.next().stderr
        self.next()
        first, second = self.copies()
        self.assertIn(str(first), said)
        self.assertRegex(second.name, r"^simulated-P02_session2_\d{8}T\d{6}Z_[0-9a-f]{12}\.db$")
        self.assertEqual(second.stat().st_mode & 0o777, 0o600)
        everything = "select * from event order by event_id"
        self.assertEqual(query(second, everything), query(self.db, everything))
        for session in (1, 2):
            said = self.run_heft("replay", "--db", second, "--session", session)
            self.assertIn("verified", said.stdout + said.stderr)

    def test_that_can_not_be_made_are_known_before_the_session(self):
        (self.folder / "file").write_text("mine")
        for folder in (self.folder / "file", self.folder / "file" / "in", "/proc/none"):
            said = self.session(self.folder / "a.db", "--backup", folder, expect=1).stderr
            self.assertIn("The session has not begun", said)
            self.assertIn(str(folder), said)
            self.assertFalse((self.folder / "a.db").exists())
        said = self.session(self.folder / "a.db", "--backup", self.folder / "new").stderr
        self.assertIn(f"a copy of the log will be saved in {self.folder / 'new'}\n", said)
        self.assertEqual([copy.suffix for copy in self.copies("new")], [".db"])

    def under_way(self, db):
        process = subprocess.Popen(
            [self.heft, "run", PROTOCOLS / "jnd.toml", "--participant", "01", "--responder",
             "simulated", "--db", db, "--backup", "copies"],
            cwd=self.folder, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not self.is_under_way(db):
            time.sleep(0.01)
        self.assertIsNone(process.poll(), "it was over before it could be stopped")
        return process

    def test_that_fail_harm_nothing_and_are_reported(self):
        db, copies = self.folder / "a.db", self.folder / "copies"
        process = self.under_way(db)
        copies.rmdir()  # as if the backup disk were removed
        copies.write_text("")
        said = process.communicate()[1]
        self.assertEqual(process.returncode, 0, said)
        self.assertIn("WARNING: there is NO BACKUP of session 1", said)
        self.assertIn("is finished", said)
        self.assertEqual(query(db, "select state from session"), [("finished",)])

    def test_continue_with_the_session_without_a_plan_too(self):
        db = self.folder / "a.db"
        process = self.under_way(db)
        process.kill()
        process.communicate()
        self.run_heft("resume", "--db", db)  # from another folder
        self.assertEqual(len(self.copies()), 1)
        said = self.run_heft("replay", "--db", db)
        self.assertIn("verified", said.stdout + said.stderr)

    def test_come_when_a_session_is_ended_for_good(self):
        db = self.folder / "a.db"
        self.kill_under_way(db)
        said = self.run_heft("resume", "--db", db, "--end", "--session", 1, "--backup",
                             self.folder / "copies")
        self.assertIn("verified backup: ", said.stderr)
        self.assertEqual(query(self.copies()[0], "select state from session"), [("aborted",)])

    def test_come_after_a_stop_too(self):
        db = self.folder / "a.db"
        process = subprocess.Popen(
            [self.heft, "run", PROTOCOLS / "jnd.toml", "--participant", "01", "--responder",
             "simulated", "--db", db, "--backup", self.folder / "copies"],
            stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not self.is_under_way(db):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
        if process.returncode == 0:
            self.skipTest("it was over before it could be stopped")
        self.assertEqual(process.returncode, 130)
        self.assertIn("verified backup: ", said)
        self.assertEqual(query(self.copies()[0], "select state from session"), [("paused",)])


class Events(StudyTest):
    def received(self, lines, db):
        """Checks that lines are the log's events in order; returns those of logged events."""
        told = [json.loads(line) for line in lines]
        self.assertEqual(told.pop()["kind"], "sealed")
        at_once = [line for line in told if line.get("logged") is False]
        self.assertTrue(at_once)
        for line in at_once:
            self.assertIn({**line, "logged": True}, told)
        told = [line for line in told if line.get("logged") is not False]
        logged = query(db, "select t_s, kind, slot from event order by event_id")
        self.assertEqual([(line["t_s"], line["kind"], line.get("slot")) for line in told], logged)
        shown = [line for line in told if line["kind"] == "cubes_shown"]
        self.assertEqual(len(shown), query(db, "select count(*) from trial")[0][0])
        self.assertEqual({line["trial"] for line in shown},
                         {n for n, in query(db, "select trial_number from trial")})
        begins, ends = (datetime.fromisoformat(told[i]["utc"].replace("Z", "+00:00"))
                        for i in (0, -1))
        self.assertAlmostEqual((ends - begins).total_seconds(), told[-1]["t_s"], delta=0.01)
        return told

    def test_come_as_datagrams(self):
        port = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        port.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        port.bind(("127.0.0.1", 0))
        self.addCleanup(port.close)
        port.settimeout(0.5)
        db, lines = self.folder / "a.db", []
        run = threading.Thread(daemon=True, target=self.session, args=(
            db, "--events", f"udp:127.0.0.1:{port.getsockname()[1]}"))
        run.start()
        while True:
            try:
                lines.append(port.recv(65536).decode())
            except TimeoutError:
                if not run.is_alive():
                    break
        run.join()
        told = self.received(lines, db)
        self.assertEqual(told[0]["kind"], "setup")
        self.assertEqual(told[0]["participant"], "01")
        self.assertNotIn("mass", "".join(lines))

    def test_come_through_a_pipe(self):
        pipe, db = self.folder / "pipe", self.folder / "a.db"
        os.mkfifo(pipe)
        reader = subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE, text=True)
        hold = os.open(pipe, os.O_WRONLY)  # opened once the reader is there
        lines = []
        read = threading.Thread(daemon=True, target=lambda: lines.extend(reader.stdout))
        read.start()
        said = self.session(db, "--events", f"fifo:{pipe}").stderr
        os.close(hold)
        read.join()
        reader.wait()
        reader.stdout.close()
        if "could not be sent" not in said:  # a slow reader may miss some
            self.received(lines, db)

    def test_without_a_reader_are_dropped_and_counted(self):
        pipe, db = self.folder / "pipe", self.folder / "a.db"
        os.mkfifo(pipe)
        said = self.session(db, "--events", f"fifo:{pipe}").stderr
        [(n,)] = query(db, "select count(*) from event")
        [(n_at_once,)] = query(db, "select count(*) from event where kind in ('cube_contact', "
                                   "'cubes_reset', 'effector_lost', 'effector_found')")
        n += n_at_once + 1  # the head
        self.assertIn(f"{n} of {n} events could not be sent", said)
        self.assertEqual(query(db, "select state from session"), [("finished",)])

    def test_on_a_serial_line_end_with_a_line_end(self):
        there, here = pty.openpty()
        os.set_blocking(there, False)
        bytes_read, over = [], threading.Event()

        def read():
            while True:
                try:
                    bytes_read.append(os.read(there, 65536))
                except BlockingIOError:
                    if over.is_set():
                        return
                    time.sleep(0.001)
        reader = threading.Thread(daemon=True, target=read)
        reader.start()
        self.session(self.folder / "a.db", "--events", f"serial:{os.ttyname(here)}")
        over.set()
        reader.join()
        for line in b"".join(bytes_read).split(b"\n")[:-1]:
            self.assertIn("kind", json.loads(line))
        self.assertTrue(b"".join(bytes_read).endswith(b"\n"))

    def test_anything_else_is_refused(self):
        for spec in ("udp", "udp:", "udp:localhost", "udp:localhost:0", "udp:localhost:65536",
                     "udp:::1:5", "tcp:localhost:5", "fifo:", f"fifo:{self.folder}",
                     "serial:/dev/null", "udp:localhost:12a"):
            said = self.session(self.folder / "a.db", "--events", spec, expect=2).stderr
            self.assertIn("expected udp:HOST:PORT", said, spec)
        said = self.session(self.folder / "a.db", "--events", "fifo:/no/pipe", expect=4).stderr
        self.assertIn("mkfifo", said)
        self.session(self.folder / "a.db", "--events", "serial:/dev/no", expect=4)
        self.assertFalse((self.folder / "a.db").exists())

    def test_of_a_session_that_continues_are_printed_too(self):
        db, pipe = self.folder / "a.db", self.folder / "pipe"
        self.kill_under_way(db)
        before = query(db, "select count(*) from event")[0][0]
        os.mkfifo(pipe)
        reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        self.run_heft("resume", "--db", db, "--events", f"fifo:{pipe}")
        first = json.loads(os.read(reader, 1 << 20).decode().splitlines()[0])
        os.close(reader)
        kind, = query(db, f"select kind from event order by event_id limit 1 offset {before}")[0]
        self.assertEqual(first["kind"], kind)


if __name__ == "__main__":
    main(__name__)

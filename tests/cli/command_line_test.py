"""Command lines that are accepted or refused, and the messages.

Run: python3 tests/cli/command_line_test.py PATH_TO_HEFT
"""
import contextlib
import json
import os
import pty
import re
import shutil
import signal
import subprocess
import termios
import time

from session_harness import PROTOCOLS, ROOT, SessionTest, commands_in, main, query

QUICK = PROTOCOLS / "quick.toml"


class CommandLine(SessionTest):
    def says(self, expect, *words, **options):
        """One line on stderr, from the program and not from a library."""
        said = self.run_heft(*words, expect=expect, **options).stderr
        self.assertTrue(said.splitlines()[-1].startswith("heft: "), said)
        return said

    def run_words(self, *words):
        return ("run", QUICK, "--responder", "coin", "--db", self.folder / "s.db", *words)


    def at_a_terminal(self, columns, *words):
        """What a command prints on a terminal."""
        terminal, end = pty.openpty()
        termios.tcsetwinsize(end, (24, columns))
        program = subprocess.Popen([self.heft, *words], stdout=end, cwd=self.folder)
        os.close(end)
        said = b""
        with contextlib.suppress(OSError):  # the terminal has gone with its program
            while part := os.read(terminal, 4096):
                said += part
        program.wait()
        os.close(terminal)
        return said.decode().replace("\r", "")


class Mistakes(CommandLine):
    def test_an_unknown_command_is_named_with_the_nearest(self):
        self.assertEqual(self.says(2, "analize"), 'heft: there is no command "analize" '
                                                  "(did you mean analyse?); heft --help lists all\n")
        self.assertIn('"qqqqqqqq"', self.says(2, "qqqqqqqq"))
        self.assertEqual(self.says(2, "calibrate", "displya"),
                         'heft: there is no command "displya" (did you mean display?); '
                         "heft calibrate --help lists all\n")
        self.assertIn("command is missing", self.says(2))

    def test_every_usage_mistake_points_to_the_help_of_its_command(self):
        for words in (["run"], ["run", QUICK, "--participant"], ["replay", "--sesion", "3"],
                      ["scene", "x.toml", "--trajectory", "y.csv", "--rate", "fast"],
                      ["simulate", QUICK, "--participants", "0"]):
            self.assertIn(f"heft {words[0]} --help", self.says(2, *words))
        said = self.says(2, "replay", "--sesion", "3")
        self.assertIn("there is no option --sesion (did you mean --session?)", said)

    def test_a_misspelled_option_is_reported_before_what_it_left_out(self):
        for wrong, meant in (("--partcipant", "--participant"), ("--participnt", "--participant")):
            said = self.says(2, "run", QUICK, wrong, "01")
            self.assertIn(f"there is no option {wrong} (did you mean {meant}?)", said)
        self.assertIn("--participant is required", self.says(2, "run", QUICK))

    def test_numbers_are_decimal_digits(self):
        for seed in ("010", "0x10", "+1", " 1", "1 ", "-1", "1.0", "1e3", "", str(2**63), str(2**64)):
            said = self.says(2, *self.run_words("--participant", "1", f"--seed={seed}"))
            self.assertIn("--seed", said)
        self.assertFalse((self.folder / "s.db").exists())
        for n, seed in enumerate((0, 2**63 - 1)):
            self.run_heft(*self.run_words("--participant", n, "--seed", seed))
        self.assertEqual(query(self.folder / "s.db", "select seed from session"),
                         [(0,), (2**63 - 1,)])
        said = self.says(2, "simulate", QUICK, "--participants", 0)
        self.assertIn("1...1000000", said)
        self.assertLess(len(said), 200)
        self.says(2, "replay", "--session", "010")

    def test_a_text_size_out_of_range_is_a_wrong_command_line(self):
        for size in ("5", "0.5", "-1", "nan", "inf", "1,5", "large"):
            said = self.says(2, *self.run_words("--participant", "1", f"--text-size={size}"))
            self.assertIn(f'--text-size: expected a number 0.75...2, got "{size}"', said)
        for size in ("0.75", "2"):
            self.run_heft(*self.run_words("--participant", size, "--text-size", size))

    def test_an_empty_value_is_no_value(self):
        for option in ("--participant", "--db", "--backup", "--events", "--language", "--simulator",
                       "--plan", "--set", "--display", "--board", "--record-camera", "--seed"):
            for words in ((option, ""), (option, " "), (f"{option}=  ",)):
                said = self.says(2, *self.run_words("--participant", "1"), *words)
                self.assertIn(f"{option}: its value is empty", said)
        self.assertIn("PROTOCOL: its value is empty", self.says(2, "run", "", "--participant", "1"))
        for words in (["resume", "--db", ""], ["replay", "--db", ""], ["analyse", "--out", ""],
                      ["validate", ""], ["simulate", QUICK, "--responder", ""],
                      ["export", "--out", ""], ["sheet", "board", "--out", ""]):
            self.assertIn("is empty", self.says(2, *words))

    def test_a_participant_is_text_that_people_can_read(self):
        too_long = "x" * 201
        for participant in ("", " ", "\u00a0\u3000", "a\nb", "a\tb", "a\x7f", "a\u0085", b"\xff",
                            b"\xc0\xaf", b"\xed\xa0\x80", b"\xe2\x82", too_long):
            words = [os.fsencode(str(word)) for word in self.run_words()]
            participant = participant if isinstance(participant, bytes) else participant.encode()
            done = subprocess.run([os.fsencode(self.heft), *words, b"--participant=" + participant],
                                  capture_output=True)
            self.assertEqual(done.returncode, 2, participant)
            self.assertTrue(done.stderr.startswith(b"heft: --participant"), done.stderr)
        self.assertFalse((self.folder / "s.db").exists())
        kept = ["007", "Zoë 3", "参加者", "😀", "y" * 200]
        for participant in kept:
            self.run_heft(*self.run_words("--participant", participant))
        self.assertEqual([p for (p,) in query(self.folder / "s.db",
                                              "select participant from session")], kept)

    def test_devices_that_are_not_there_and_options_that_do_not_fit(self):
        self.says(4, *self.run_words("--participant", "1", "--tracker", "camera:63"))
        for option, value, hint in (("--tracker", "camra:0", "camera"), ("--view", "windw", "window"),
                                    ("--tracker", "hnd", "hand"), ("--view", "zzzzzzz", "headless"),
                                    ("--tracker", "camera", "camera:N"), ("--tracker", "hand:1", "no argument"),
                                    ("--tracker", "frames:d", "--camera-file"),
                                    ("--view", "video", "video:FILE"), ("--view", "window:1", "no argument"),
                                    ("--purpose", "fun", "pilot")):
            self.assertIn(hint, self.says(2, *self.run_words("--participant", "1", option, value)))
        self.assertIn("--view window", self.says(2, "run", QUICK, "--participant", "1", "--responder",
                                                 "human", "--tracker", "hand", "--view", "headless",
                                                 "--db", self.folder / "s.db"))
        self.assertIn("fr", self.says(2, *self.run_words("--participant", "1", "--language", "frr")))
        self.assertFalse((self.folder / "s.db").exists())

    def test_a_log_must_be_a_file(self):
        pipe, folder = self.folder / "pipe", self.folder / "folder"
        os.mkfifo(pipe)
        folder.mkdir()
        for db in (pipe, folder, "/dev/null", "x" * 300, self.folder / "no" / "folder" / "s.db"):
            self.says(1, "run", QUICK, "--participant", "1", "--responder", "coin", "--db", db)
            self.says(1, "simulate", QUICK, "--participants", "1", "--db", db)
            self.says(1, "resume", "--db", db)
            self.says(1, "replay", "--db", db)
            self.says(1, "analyse", "--db", db)
        self.assertEqual(os.listdir(folder), [])

    def test_what_a_library_throws_is_reported_without_a_crash(self):
        self.assertIn("/dev/null", self.says(1, "demo", "--out", "/dev/null/x"))


class Output(CommandLine):
    def test_output_that_can_not_be_written_is_a_failure_in_one_line(self):
        db = self.folder / "s.db"
        self.session(db)
        for words in (["--version"], ["--help"], ["run", "--help"], ["analyse", "--db", db],
                      ["analyse", "--db", db, "--json"], ["replay", "--db", db],
                      ["validate", QUICK], ["doctor", "--responder", "simulated"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([self.heft, *map(str, words)], stdout=full,
                                      stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1, words)
            self.assertIn("heft: cannot write to the standard output: No space left", done.stderr)
            self.assertEqual(done.stderr.count("heft: "), 1, done.stderr)

    def test_talk_that_can_not_be_written_ends_nothing(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([self.heft, *map(str, self.run_words("--participant", "1"))],
                                  stderr=full)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(query(self.folder / "s.db", "select state from session"), [("finished",)])

    def test_help_reads_the_same_everywhere(self):
        for command, positional in (("run", "PROTOCOL"), ("validate", "FILE"), ("procedure", "FILE"),
                                    ("scene", "SCENE.toml"), ("simulate", "PROTOCOL")):
            for option in ("--help", "--help-all"):
                self.assertIn(f"\n  {positional} ", self.run_heft(command, option).stdout)
            self.assertIn("print this help", self.run_heft(command, "--help-all").stdout)

    def every_command(self):
        listed = commands_in(self.run_heft("help").stdout)
        self.assertGreater(len(listed), 15)
        return [[]] + [[name] for name in listed if name != "bench"] + [["calibrate", "camera"], ["sheet", "board"]]

    def test_help_fits_one_terminal_screen(self):
        for words in self.every_command():
            with self.subTest(words=words):
                lines = self.run_heft(*words, "--help").stdout.splitlines()
                self.assertLessEqual(len(lines), 24)
                self.assertLessEqual(max(map(len, lines)), 80)

    def test_a_newcomer_reads_what_to_do_next_in_ten_lines(self):
        lines = self.at_a_terminal(80).splitlines()
        self.assertLessEqual(len(lines), 10)
        self.assertIn("What next?", lines[0])
        known = self.run_heft("--help").stdout
        commands = re.findall(r"heft ([a-z]+)", "\n".join(lines[1:]))
        self.assertEqual({"demo", "run", "new", "doctor", "validate", "list", "analyse", "export"},
                         set(commands) - {"help", "runs"})
        for command in set(commands) - {"help"}:
            self.assertRegex(known, rf"(?m)^  {command} ")
        protocol = re.search(r"heft run (\S+) --participant me", "\n".join(lines)).group(1)
        self.run_heft("validate", protocol, cwd=self.folder)

    def test_lines_of_doctor_break_between_words(self):
        verdicts = self.at_a_terminal(80, "doctor", "--db", "x.db").split("\ncameras:")[0]
        lines = verdicts.splitlines()
        self.assertLessEqual(max(map(len, lines)), 80, lines)
        self.assertTrue(any(line.startswith(" " * 24) for line in lines), lines)

    def test_help_is_a_command_too(self):
        for words in self.every_command():
            self.assertEqual(self.run_heft("help", *words).stdout,
                             self.run_heft(*words, "--help").stdout)
        self.assertIn("did you mean analyse?", self.says(2, "help", "analyze"))

    def test_short_help_names_every_option(self):
        option = re.compile(r"--[a-z][a-z-]+")
        for words in self.every_command()[1:]:
            short = option.findall(self.run_heft(*words, "--help").stdout)
            for name in re.findall(r"^  (?:-h,)?(--[a-z-]+)", self.run_heft(*words, "--help-all").stdout, re.M):
                if name not in ("--help", "--help-all"):
                    self.assertIn(name, short, words)

    def test_help_is_wrapped_to_the_terminal_and_ends_with_examples(self):
        for command in ("run", "resume", "simulate", "replay", "doctor"):
            at_80 = self.run_heft(command, "--help-all").stdout.split("Examples:")
            self.assertEqual(len(at_80), 2, command)
            narrow = self.at_a_terminal(70, command, "--help-all").split("Examples:")
            for options, examples, width in (at_80 + [80], narrow + [70]):
                self.assertLessEqual(max(map(len, options.splitlines())), width)
                self.assertLessEqual(max(map(len, examples.splitlines())), width)
            self.assertEqual(narrow[0].split(), at_80[0].split())
            one_line = [part.replace(" \\\n     ", "") for part in (narrow[1], at_80[1])]
            self.assertEqual(one_line[0], one_line[1])

    def test_help_shows_defaults(self):
        words = {command: " ".join(self.run_heft(command, "--help-all").stdout.split())
                 for command in ("run", "resume")}
        for default in ("(default: human)", "(default: camera:0 for a person, hand for a model)",
                        "(default: protocols/apparatus/board.toml)"):
            self.assertIn(default, words["run"])
            self.assertNotIn(default, words["resume"])
        self.assertIn("the rest is kept", words["resume"])
        self.assertIn("--purpose main|pilot|test", words["run"])
        self.assertIn("(default: main, but test with --tracker mouse)", words["run"])

    def completed(self, *words):
        script = self.run_heft("completion", "bash").stdout
        asked = " ".join(f"'{word}'" for word in words)
        script += (f"COMP_WORDS=({asked}) COMP_CWORD={len(words) - 1}\n_heft_completion\n"
                   'printf "%s\\n" "${COMPREPLY[@]}"\n')
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_commands_and_options(self):
        self.assertEqual(self.completed("heft", "res"), ["resume"])
        self.assertEqual(self.completed("heft", "calibrate", "c"), ["camera"])
        self.assertEqual(self.completed("heft", "run", "--part"), ["--participant"])
        self.assertEqual(self.completed("heft", "resume", "--db", "x.db", "--un"), ["--unblind"])
        self.assertEqual(self.completed("heft", "calibrate", "camera", "--exp"), ["--exposure-ms"])
        self.assertEqual(self.completed("heft", "run", "proto"), [])  # bash's own: files

    def test_zsh_completes_the_same(self):
        zsh = shutil.which("zsh")
        if not zsh:
            self.skipTest("needs zsh")
        for words, expected in ((["heft", "res"], "resume"), (["heft", "run", "--part"],
                                                              "--participant")):
            script = ("compdef() { }; _files() { }; compadd() { shift; print -l -- $@; }\n"
                      + self.run_heft("completion", "zsh").stdout
                      + f"words=({' '.join(words)}) CURRENT={len(words)}\n_heft_completion\n")
            done = subprocess.run([zsh, "-f", "-c", script], capture_output=True, text=True)
            self.assertEqual(done.stderr, "")
            self.assertIn(expected, done.stdout.split())

    def test_fish_completes_the_same(self):
        fish = shutil.which("fish")
        if not fish:
            self.skipTest("needs fish")
        script = self.run_heft("completion", "fish").stdout
        for line, expected in (("heft res", "resume"), ("heft run --part", "--participant"),
                               ("heft calibrate c", "camera")):
            done = subprocess.run([fish, "-N", "-c", script + f"complete -C '{line}'\n"],
                                  capture_output=True, text=True)
            self.assertIn(expected, done.stdout.split())
            self.assertEqual(done.stdout.split().count(expected), 1, done.stdout)

    def test_the_manual_page_has_every_command(self):
        page = self.run_heft("completion", "man").stdout
        for line in (".TH HEFT 1", ".SS heft run", ".SS heft calibrate camera"):
            self.assertIn("\n" + line, "\n" + page)
        self.assertIn("\\-\\-participant", page)

    def test_a_report_without_gnuplot_says_how_to_get_charts(self):
        db = self.folder / "s.db"
        self.session(db)
        said = self.run_heft("analyse", "--db", db, "--out", self.folder / "report",
                             env={"PATH": str(self.folder)}).stdout
        self.assertIn("gnuplot is not installed", said)


class GoingOn(CommandLine):
    def start_and_stop(self, db, *words, with_signal=signal.SIGTERM):
        return self.stop(["run", PROTOCOLS / "jnd.toml", "--participant", "01", "--seed", "5",
                          "--db", db, *words], lambda: self.count(db, "true") > 3, with_signal)

    def stop(self, words, when, with_signal=signal.SIGTERM):
        process = subprocess.Popen([self.heft, *words], stderr=subprocess.PIPE, text=True,
                                   cwd=self.folder)
        while process.poll() is None and not when():
            time.sleep(0.005)
        process.send_signal(with_signal)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        return said

    def count(self, db, which):
        try:
            return query(db, f"select count(*) from event where {which}")[0][0]
        except Exception:  # the file is still being made
            return 0

    def changes(self, db):
        """What each setup after the first changed: name, before, after; but for the drawn numbers."""
        setups = [json.loads(detail) for (detail,) in
                  query(db, "select detail from event where kind = 'setup' order by event_id")]
        return [(key, old.get(key, ""), new.get(key, "")) for old, new in zip(setups, setups[1:])
                for key in sorted((old | new).keys() - {"participant_parameters"})
                if old.get(key, "") != new.get(key, "")]

    def test_a_closed_terminal_saves_everything(self):
        db = self.folder / "s.db"
        said = self.start_and_stop(db, "--responder", "simulated", with_signal=signal.SIGHUP)
        self.assertIn("heft resume", said)
        self.assertEqual(query(db, "select state from session"), [("paused",)])

    def test_a_responder_given_again_holds_for_the_rest_and_is_logged(self):
        db = self.folder / "s.db"
        self.start_and_stop(db, "--responder", "simulated")
        said = self.run_heft("resume", "--db", db, "--responder", "coin", "--tracker", "hand",
                             "--view", "headless", "--simulator", "boxes").stderr
        self.assertIn("coin instead of simulated", said)
        self.assertEqual(self.changes(db), [("responder", "simulated", "coin")])
        self.assertEqual(query(db, "select name, value from participant_parameter join setup using "
                                   "(setup_id) where responder = 'coin'"), [("p", 0.5)])
        kinds = [kind for (kind,) in query(db, "select kind from event order by event_id")]
        self.assertEqual(kinds[kinds.index("resumed") + 1], "setup")
        [(touched,)] = query(db, "select max(n_pushes) from cube join trial using (trial_id) where "
                                 "started_s > (select t_s from event where kind = 'resumed')")
        self.assertEqual(touched, 0, "a coin touches no cube")
        self.run_heft("replay", "--db", db)

    def test_it_still_holds_when_the_session_is_resumed_once_more(self):
        db, parameters = self.folder / "s.db", self.folder / "mine.toml"
        parameters.write_text("criterion_mm = 3\n")
        self.start_and_stop(db, "--responder", "coin")
        self.stop(["resume", "--db", db, "--responder", "simulated:mine.toml"],
                  lambda: self.count(db, "kind = 'setup'") == 2)
        self.assertEqual(self.changes(db),
                         [("responder", "coin", f"simulated:{parameters}"),
                          ("responder_text", "", "criterion_mm = 3\n")])
        parameters.unlink()
        self.run_heft("resume", "--db", db)
        self.assertEqual(self.count(db, "kind = 'setup'"), 2)
        self.assertEqual(self.count(db, "kind = 'deviation'"), 0)
        [(least_touched,)] = query(db, "select min(n) from (select sum(n_pushes) n from cube join "
                                       "trial using (trial_id) where status = 'completed' and "
                                       "started_s > (select max(t_s) from event where kind = "
                                       "'resumed') group by trial_id)")
        self.assertGreater(least_touched, 0, "not the coin, which touches no cube")
        self.run_heft("replay", "--db", db)

    def test_another_simulator_holds_for_the_rest_and_is_logged(self):
        db = self.folder / "s.db"
        self.start_and_stop(db, "--responder", "simulated")
        said = self.run_heft("resume", "--db", db, "--simulator", "bullet-ea").stderr
        self.assertIn("bullet-ea instead of boxes", said)
        self.assertEqual([key for key, _, _ in self.changes(db)][:1], ["simulator"])
        self.assertEqual(query(db, "select distinct simulator from trial join setup using "
                                   "(setup_id) order by trial_id"), [("boxes",), ("bullet-ea",)])
        self.assertIn("verified", self.run_heft("replay", "--db", db).stdout)

    def test_what_is_not_there_is_refused_and_nothing_is_logged(self):
        db = self.folder / "s.db"
        self.start_and_stop(db, "--responder", "simulated")
        before = query(db, "select count(*) from event")
        self.says(2, "resume", "--db", db, "--simulator", "bulet")
        self.says(2, "resume", "--db", db, "--responder", "coyn")
        self.says(4, "resume", "--db", db, "--tracker", "camera:0")
        self.says(4, "resume", "--db", db, "--view", "window")
        self.assertEqual(query(db, "select count(*) from event"), before)
        self.run_heft("resume", "--db", db)

    def test_files_are_logged_with_their_whole_path(self):
        db = self.folder / "s.db"
        (self.folder / "mine.toml").write_text("p = 0.75\n")
        (self.folder / "hand").mkdir()
        (self.folder / "hand" / "actions.csv").write_text("trial_number,t_s,action,slot,label\n")
        trajectory = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,-0.2,0.02,1,0,0,0\n5,0,-0.2,0.02,1,0,0,0\n"
        # A spreadsheet puts a byte-order mark in front.
        (self.folder / "hand" / "trial_1.csv").write_text("\ufeff" + trajectory, encoding="utf-8")
        for participant, responder, code in (("1", "coin:mine.toml", 0), ("2", "scripted:hand", 1)):
            self.run_heft("run", QUICK, "--participant", participant, "--responder", responder, "--db",
                          db, cwd=self.folder, expect=code)
        rows = query(db, "select responder, run_options from session order by session_id")
        for (responder, options), expected in zip(rows, ("coin:{}/mine.toml", "scripted:{}/hand")):
            self.assertEqual(responder, expected.format(self.folder))
            self.assertEqual(json.loads(options)["responder"], responder)
        # Resumed from another folder, it finds the recording, which ends too early again.
        said = self.run_heft("resume", "--db", db, cwd=ROOT, expect=1).stderr
        self.assertIn("no more actions", said)

    def test_what_if_reads_no_parameters_of_another_responder(self):
        db = self.folder / "s.db"
        (self.folder / "mine.toml").write_text("lapse_rate = 0.5\n")
        self.run_heft("run", QUICK, "--participant", "1", "--responder", "simulated:mine.toml",
                      "--db", db, cwd=self.folder)
        self.run_heft("replay", "--db", db, "--responder", "coin")


class Simulating(CommandLine):
    def simulate(self, db, n, *words, protocol=QUICK):
        return self.run_heft("simulate", protocol, "--participants", n, "--seed", 9, "--db", db, *words)

    def test_a_file_with_simulated_participants_gets_the_next_ones(self):
        db, whole = self.folder / "s.db", self.folder / "whole.db"
        self.assertNotIn("already", self.simulate(db, 2).stderr)
        self.assertIn("continuing with sim-0003", self.simulate(db, 3, "--jobs", 2).stderr)
        self.simulate(whole, 5, "--jobs", 1)
        for sql in ("select participant, seed from session",
                    "select participant, trial_number, level_g, chosen_slot, outcome, ended_s "
                    "from session join trial using (session_id) order by trial_id"):
            self.assertEqual(query(db, sql), query(whole, sql))

    def test_another_protocol_starts_from_one(self):
        db, other = self.folder / "s.db", self.folder / "other.toml"
        shutil.copy(QUICK, other)
        self.simulate(db, 2)
        self.run_heft(*self.run_words("--participant", "sim-x7"))
        self.simulate(db, 1, protocol=other)
        self.assertEqual([p for (p,) in query(db, "select participant from session")],
                         ["sim-0001", "sim-0002", "sim-x7", "sim-0001"])


    def test_the_surrogate_stores_no_frames(self):
        said = self.says(2, "simulate", QUICK, "--level", "surrogate", "--frames")
        self.assertIn("use --level hand", said)


class ByteOrderMarks(CommandLine):
    def test_a_trajectory_from_a_spreadsheet_is_read(self):
        push = self.folder / "push.csv"
        scenes = ROOT / "tests" / "scenes"
        push.write_bytes(b"\xef\xbb\xbf" + (scenes / "paths" / "push.csv").read_bytes())
        scene = scenes / "pushes" / "push_200g.toml"
        outputs = {self.run_heft("scene", scene, "--trajectory", path).stdout
                   for path in (push, scenes / "paths" / "push.csv")}
        self.assertEqual(len(outputs), 1)

    def test_a_protocol_with_a_mark_is_read(self):
        protocol = self.folder / "quick.toml"
        protocol.write_bytes(b"\xef\xbb\xbf" + QUICK.read_bytes())
        self.run_heft("validate", protocol)


if __name__ == "__main__":
    main("__main__")

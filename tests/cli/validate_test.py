"""heft validate from the outside: exit codes, what goes to stdout and to stderr, file kinds.

Run as: python3 tests/cli/validate_test.py PATH_TO_HEFT
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROTOCOLS = pathlib.Path(__file__).resolve().parents[2] / "protocols"
HEFT = "heft"

PROCEDURE = """seed = 42
[[staircase]]
name = "15g"
start = 175
step = 50
floor = 0
"""
SCENE = """friction = 0.8
[[cube]]
mass_kg = 0.2
size_m = 0.035
position_m = [0, 0, 0.0175]
"""


class Validate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        path.write_text(text, encoding="utf-8")
        return str(path)

    def validate(self, *paths):
        return subprocess.run(
            [HEFT, "validate", *map(str, paths)], capture_output=True, text=True, timeout=60
        )

    def test_what_only_large_letters_do_not_fit_is_reported_of_texts(self):
        english = (PROTOCOLS / "texts" / "en.toml").read_text(encoding="utf-8")
        self.assertIn('title = "Welcome"', english)
        path = self.file("de.toml", english.replace(
            'title = "Welcome"', 'title = "Donaudampfschifffahrtsgesellschaft"'))
        said = self.validate(path).stderr
        self.assertIn("with --text-size 2, on a screen of 1024 x 600: welcome: "
                      '"Donaudampfschifffahrtsgesellschaft" does not fit', said)
        self.assertEqual(len(said.splitlines()), 1, said)
        for language in ("en", "fr"):
            self.assertEqual("", self.validate(PROTOCOLS / "texts" / f"{language}.toml").stderr)

    def test_a_protocol_that_models_do_not_get_through_is_valid_with_a_caution(self):
        text = (PROTOCOLS / "jnd.toml").read_text(encoding="utf-8")
        soft = self.file("soft.toml", "require_contact = true\n"
                         "coupling = { stiffness_n_per_m = 0.001 }\n" + text)
        result = self.validate(soft)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, "a simulated participant cannot complete it: trial "
                         r"\d+: .* not every cube was touched")

    def questioned(self, text):
        """A protocol that asks a questionnaire of one choice."""
        self.file("q_x.en.toml", '''[questionnaire.q_x]
title = "One"
# A comment may have what it wants: \U0010ffff
[[questionnaire.q_x.question]]
key = "c"
kind = "choice"
text = "%s"
choice = [{ value = "a", text = "Apple" },
          { value = "b", text = "Donaudampfschifffahrtsgesellschaftskapitaenskajuetenschluesselanhaenger" }]
''' % text)
        quick = (PROTOCOLS / "quick.toml").read_text(encoding="utf-8")
        return self.file("asks.toml", quick.replace(
            "\n[[block]]", '\n[[screens.questionnaire]]\nname = "q_x"\nafter = "sorting"\n\n[[block]]', 1))

    def test_questionnaires_that_a_protocol_asks_are_checked_with_it(self):
        asks = self.questioned("Choose one")
        run = self.validate(asks)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stderr, r"q_x\.en\.toml: on a screen of 1024 x 600: questionnaire_q_x: "
                                     '"Donau.*" does not fit')

    def test_questions_of_trials_are_checked_beside_the_cubes(self):
        self.file("q_y.en.toml", '''[questionnaire.q_y]
title = "One"
[[questionnaire.q_y.question]]
key = "c"
kind = "choice"
text = "Which?"
choice = [{ value = "a", text = "Apple" }, { value = "b", text = "Ananaskirschmarmeladenbrotaufstrichverkostung" }]
[[questionnaire.q_y.question]]
key = "spoken"
kind = "text"
text = "Why?"
''')
        judgment = (PROTOCOLS / "examples" / "judgment.toml").read_text(encoding="utf-8")
        fits = self.validate(self.file("fits.toml", judgment))
        self.assertEqual((fits.returncode, fits.stderr), (0, ""))
        self.assertIn("about 12 trials", fits.stdout)
        wide = self.validate(self.file("wide.toml", judgment.replace(
            '"dissimilarity.heaviness"', '"q_y.c"')))
        self.assertEqual(wide.returncode, 0, wide.stderr)
        self.assertRegex(wide.stderr, r'q_y\.en\.toml: on a screen of 1024 x 600: trial_judgment: "Ananas')
        line = judgment[:judgment.index("\nquestion =")].count("\n") + 2
        for name in ("q_y.none", "q_y.spoken"):
            lacking = self.validate(self.file("lacking.toml", judgment.replace(
                "dissimilarity.heaviness", name)))
            self.assertEqual((lacking.returncode, lacking.stdout), (3, ""))
            self.assertRegex(lacking.stderr, rf"lacking\.toml:{line}:12: block pairs asks .*q_y\.en\.toml lacks; expected .c.\n")

    def test_a_character_without_font_hides_no_word_that_does_not_fit(self):
        asks = self.questioned("Choose \U0010ffff")
        plan = self.file("plan.toml", '''study = "x"
participants = 2
seed = 3
id_prefix = "P"
protocol = "asks.toml"
''')
        for path in (asks, plan, str(pathlib.Path(self.folder.name) / "q_x.en.toml")):
            run = self.validate(path)
            self.assertEqual((run.returncode, run.stdout), (3, ""), run.stderr)
            self.assertRegex(run.stderr, r"q_x\.en\.toml:7: characters that no installed font has: "
                                         r"U\+10FFFF in questionnaire_q_x\.c; install")
            self.assertIn("Donaudampf", run.stderr)
            self.assertIn(": 1 mistake", run.stderr)

    def test_every_shipped_protocol_is_ok(self):
        paths = sorted(PROTOCOLS.glob("*.toml"))
        self.assertGreaterEqual(len(paths), 5)
        run = self.validate(*paths)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        said = re.split(r"\n(?! )", run.stdout.rstrip())
        for path, text in zip(paths, said, strict=True):
            self.assertRegex(
                text,
                rf"^{re.escape(str(path))}: ok, a protocol: about \d+ trials"
                r"( \(\d+ to \d+ in 6 simulated participants\))? and \d+ min\n"
                r"  assuming a trial of .*(\n  .*)?\n  what a study can find: heft power$"
            )
            for line in text.splitlines()[1:]:
                self.assertLessEqual(len(line), 80)

    def test_a_simulator_for_one_stroke_is_warned_of_and_no_mistake(self):
        text = (PROTOCOLS / "quick.toml").read_text(encoding="utf-8")
        path = self.file("a.toml", text + '[physics]\nsimulator = "push"\n')
        run = self.validate(path)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"ok, a protocol: about \d+ trials and \d+ min")
        self.assertIn("models one straight push", run.stderr)

    def test_cautions_of_a_technique_that_replaces_a_predefined_one(self):
        text = (PROTOCOLS / "quick.toml").read_text(encoding="utf-8")
        for name, expected in (("C2", 1), ("soft", 0)):
            run = self.validate(self.file(
                "a.toml", text + f'[[technique]]\nname = "{name}"\nkind = "spring"\n'))
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(run.stderr.count(f'name = "{name}" replaces the predefined'), expected)

    def test_two_ways_to_count_trials_are_one_too_many(self):
        run = self.validate(self.file("a.toml", '''title = "t"
[[block]]
kind = "estimation"
name = "e"
masses_g = [20, 50]
trials_per_mass = 2
scale = "slider"
[block.trials]
C1 = 2
'''))
        self.assertEqual(run.returncode, 3)
        self.assertIn("a.toml:6:19: trials_per_mass together with [block.trials]", run.stderr)
        self.assertNotIn("unknown", run.stderr)

    def test_warns_of_choices_for_see_through_displays(self):
        text = (PROTOCOLS / "quick.toml").read_text(encoding="utf-8")
        path = self.file("a.toml", text + '[physics]\ninput = "hold"\npredict_s = 0.05\n')
        run = self.validate(path)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(": ok, a protocol: ", run.stdout)
        held, predicted = run.stderr.splitlines()
        self.assertRegex(held, rf'^{re.escape(path)}: .*input = "hold" is for see-through .*"path"')
        # 50 N/m times 15 mm are the friction of 95.6 g.
        self.assertRegex(predicted, rf"^{re.escape(path)}: .*predict_s = 0.05 .*15 mm .* 96 g")

    def test_cautions_of_stop_rules_out_of_reach_and_of_quests_default_for_forced_choices(self):
        staircase = ('[[block.staircase]]\nname = "{0}"\nreference_g = 200\nkind = "{0}"\n'
                     'floor = 0\nstop_trials = 20\n')
        comparison = '[[block]]\nkind = "comparison"\nname = "c"\n'
        up_down = staircase.format("up_down") + "start = 100\nstep = 10\nstop_reversals = {}\n"
        quest = staircase.format("quest") + "guess = 100\nguess_sd = 80\nbeta = 0.02\ngrain = 2\n"
        reversals = '"up_down" cannot reach its 20 reversals in 20 trials'
        gamma = '"quest" expects a share gamma = 0.5 of positive answers'
        for block, expected in ((comparison + up_down.format(20), reversals),
                                (comparison + up_down.format(19), None),
                                (comparison + quest, gamma),
                                (comparison + quest + "gamma = 0.05\n", None),
                                (comparison + 'answers = "heavier"\n' + quest, None)):
            run = self.validate(self.file(
                "a.toml", 'title = "t"\n[layout]\nout_of_area = "together"\n' + block))
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1 if expected else 0, run.stderr)
            self.assertIn(expected or "", run.stderr)

    def test_a_language_that_does_not_exist_is_named_with_its_place(self):
        text = (PROTOCOLS / "paper.toml").read_text(encoding="utf-8")
        path = self.file("a.toml", "# in the language \"de\"\n"
                         + text.replace('language = "en"', 'language = "de"'))
        line = text[:text.index('language = "en"')].count("\n") + 2
        run = self.validate(path)
        self.assertEqual(run.returncode, 3)
        self.assertIn(f'{path}:{line}:12: there is no language "de"', run.stderr)

    def test_large_letters_are_checked_on_screens_of_the_protocols_tasks_only(self):
        text = (PROTOCOLS / "paper.toml").read_text(encoding="utf-8")
        run = self.validate(self.file("a.toml", text.replace("text_size = 1", "text_size = 2")))
        self.assertEqual(run.returncode, 0, run.stderr)
        pages = set(re.findall(r"1024 x 600: trial_(\w+):", run.stderr))
        self.assertIn("sorting", pages)
        self.assertLessEqual(pages, {"introduction", "sorting", "comparison"})

    def test_says_what_it_took_a_file_for(self):
        procedure, scene = self.file("a.toml", PROCEDURE), self.file("b.toml", SCENE)
        run = self.validate(procedure, scene)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(
            run.stdout.splitlines(),
            [f"{procedure}: ok, a procedure file: 1 staircase",
             f"{scene}: ok, a scene file: 1 cube"],
        )

    def test_every_shipped_text_file_is_ok(self):
        for path in sorted((PROTOCOLS / "texts").glob("*.toml")):
            run = self.validate(path)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertRegex(
                run.stdout,
                rf'^{re.escape(str(path))}: ok, a text file: \d+ pages in the language "{path.stem}"$',
            )

    def test_a_text_file_says_which_word_is_missing(self):
        english = (PROTOCOLS / "texts" / "en.toml").read_text(encoding="utf-8")
        run = self.validate(self.file("a.toml", english.replace("agree =", "agre =", 1)))
        self.assertEqual(run.returncode, 3)
        self.assertIn('"agree"?', run.stderr)

    def test_reports_every_mistake_of_every_file(self):
        procedure = self.file("a.toml", PROCEDURE.replace("175", "-175").replace("50", "0"))
        good = self.file("good.toml", PROCEDURE)
        scene = self.file("b.toml", SCENE.replace("mass_kg", "mas_kg"))
        run = self.validate(procedure, good, scene)
        self.assertEqual(run.returncode, 3)
        self.assertEqual(run.stdout.splitlines(), [f"{good}: ok, a procedure file: 1 staircase"])
        places = re.findall(r"^(\S+:\d+:\d+): ", run.stderr, re.MULTILINE)
        self.assertEqual(places, [f"{procedure}:4:9", f"{procedure}:5:8", f"{scene}:3:1"])
        self.assertIn('"mass_kg"?', run.stderr)

    def test_a_syntax_error_has_its_place(self):
        path = self.file("a.toml", PROCEDURE + "x = = 3\n")
        run = self.validate(path)
        self.assertEqual(run.returncode, 3)
        self.assertIn(f"{path}:7:5: not valid TOML", run.stderr)

    def test_an_unreadable_file_fails(self):
        missing = str(pathlib.Path(self.folder.name) / "missing.toml")
        for path in (missing, self.folder.name):
            run = self.validate(path)
            self.assertEqual((run.returncode, run.stdout), (1, ""))
            self.assertIn(path, run.stderr)

    def test_the_other_files_are_checked_after_an_unreadable_one(self):
        missing = str(pathlib.Path(self.folder.name) / "missing.toml")
        run = self.validate(missing, self.file("a.toml", PROCEDURE.replace("seed", "sed")))
        self.assertEqual(run.returncode, 3)
        self.assertIn("missing.toml", run.stderr)
        self.assertIn('"seed"?', run.stderr)

    def test_a_file_of_no_kind_is_invalid(self):
        path = self.file("a.toml", 'color = "red"\n')
        run = self.validate(path)
        self.assertEqual(run.returncode, 3)
        self.assertIn(f"{path}:1:1: ", run.stderr)

    def test_no_file_is_a_usage_error(self):
        self.assertEqual(self.validate().returncode, 2)

    def test_help_shows_examples(self):
        run = self.validate("--help")
        self.assertEqual(run.returncode, 0)
        self.assertIn("heft validate protocols/paper.toml", run.stdout)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        HEFT = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()

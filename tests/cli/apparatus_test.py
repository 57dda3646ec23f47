"""heft validate, sheet and calibrate on boards and effectors, from the outside.

Run as: python3 tests/cli/apparatus_test.py PATH_TO_HEFT
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

APPARATUS = pathlib.Path(__file__).resolve().parents[2] / "protocols" / "apparatus"
HEFT = "heft"


class Apparatus(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def heft(self, *arguments):
        return subprocess.run(
            [HEFT, *map(str, arguments)], capture_output=True, text=True, timeout=300
        )

    def sheet(self, what, *more):
        out = self.folder / f"{what}.pdf"
        file = APPARATUS / f"{what}.toml"
        return self.heft("sheet", what, f"--{what}", file, "--out", out, *more), out

    def test_validate_says_what_the_shipped_apparatus_is(self):
        run = self.heft("validate", APPARATUS / "board.toml", APPARATUS / "effector.toml")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        board, effector = run.stdout.splitlines()
        self.assertIn("ok, a board file: 24 tags of tag36h11, 40 mm, ids 0-23", board)
        self.assertIn("ok, an effector file: 5 tags of tag36h11, 32 mm, ids 30-34", effector)

    def test_mistakes_have_their_places(self):
        text = (APPARATUS / "board.toml").read_text(encoding="utf-8")
        path = self.folder / "board.toml"
        path.write_text(text.replace("pitch_m", "pich_m").replace("rows = 4", "rows = 0"))
        run = self.heft("validate", path)
        self.assertEqual(run.returncode, 3)
        self.assertEqual(len(re.findall(rf"^{re.escape(str(path))}:\d+:\d+: ", run.stderr, re.M)), 2)
        self.assertIn('"pitch_m"?', run.stderr)

    def test_sheets_have_the_papers_size_and_the_ruler(self):
        for what, size in (("board", "841.89 x 595.276"), ("effector", "595.276 x 841.89")):
            run, out = self.sheet(what)
            self.assertEqual((run.returncode, run.stdout), (0, ""), run.stderr)
            self.assertIn("ruler_measured_m", run.stderr)
            info = subprocess.run(["pdfinfo", out], capture_output=True, text=True, check=True)
            self.assertRegex(info.stdout, r"Pages:\s+2")
            self.assertIn(size, info.stdout)
            words = subprocess.run(["pdftotext", out, "-"], capture_output=True, text=True)
            self.assertIn("100 %", words.stdout)
            self.assertIn("ruler_measured_m", words.stdout)

    def test_the_letter_board_fits_letter_paper_in_true_millimeters(self):
        out = self.folder / "letter.pdf"
        run = self.heft("sheet", "board", "--board", APPARATUS / "board_letter.toml", "--paper",
                        "letter", "--out", out)
        self.assertEqual(run.returncode, 0, run.stderr)
        info = subprocess.run(["pdfinfo", out], capture_output=True, text=True, check=True)
        self.assertIn("792 x 612", info.stdout)
        # At 127 dots an inch a millimeter is 5 dots: the black squares' rows and columns.
        subprocess.run(["pdftoppm", "-r", "127", "-f", "1", "-singlefile", "-gray", out,
                        self.folder / "letter"], check=True)
        header, pixels = (self.folder / "letter.pgm").read_bytes().split(b"\n255\n", 1)
        width, height = map(int, header.split()[1:3])
        self.assertAlmostEqual(width, 279.4 * 5, delta=2)
        row = pixels[int(0.35 * height) * width:][:width]
        dark = [x for x in range(width) if row[x] < 128]
        self.assertAlmostEqual(dark[-1] + 1 - dark[0], (5 * 45.6 + 38) * 5, delta=2)

    def test_sheets_refuse_paper_that_is_too_small_or_unknown(self):
        run, out = self.sheet("board", "--paper", "letter")
        self.assertEqual(run.returncode, 1)
        self.assertIn("280 x 184 mm", run.stderr)
        self.assertIn("board_letter.toml", run.stderr)
        self.assertFalse(out.exists())
        run, _ = self.sheet("board", "--paper", "leter")
        self.assertEqual(run.returncode, 2)
        self.assertIn('"letter"', run.stderr)

    def calibrate_camera(self, source):
        out = self.folder / "camera.yaml"
        run = self.heft("calibrate", "camera", "--camera", source,
                        "--board", APPARATUS / "board.toml", "--out", out)
        self.assertFalse(out.exists())
        return run

    def test_calibrating_needs_a_camera(self):
        run = self.calibrate_camera("camera:97")
        self.assertEqual((run.returncode, run.stdout), (4, ""))
        self.assertEqual(self.calibrate_camera("webcam:0").returncode, 2)

    def test_calibrating_needs_different_views(self):
        _, pdf = self.sheet("board")
        frames = self.folder / "frames"
        frames.mkdir()
        for name in "abcdefgh":
            subprocess.run(["pdftoppm", "-r", "60", "-f", "1", "-singlefile", "-png", pdf,
                            frames / name], check=True)
        run = self.calibrate_camera(f"frames:{frames}")
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertIn("of 8 picture(s) 1 were kept; 7 are too much like one", run.stderr)
        self.assertIn("at least 5", run.stderr)
        for missing in ("tilt the board", "nearer and farther", "19 more views"):
            self.assertIn(missing, run.stderr)
        self.assertNotIn("right board file", run.stderr)

    def test_calibrating_needs_pictures_of_the_board(self):
        frames = self.folder / "frames"
        frames.mkdir()
        (frames / "a.pgm").write_bytes(b"P5 64 48 255\n" + bytes(64 * 48))
        run = self.calibrate_camera(f"frames:{frames}")
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertIn("right board file", run.stderr)

    def test_calibrating_the_effector_needs_its_tags_and_the_cameras_size(self):
        frames = self.folder / "frames"
        frames.mkdir()
        _, pdf = self.sheet("board")
        subprocess.run(["pdftoppm", "-scale-to-x", "640", "-scale-to-y", "480", "-f", "1",
                        "-singlefile", "-png", pdf, frames / "a"], check=True)
        arguments = ["calibrate", "effector", "--camera", f"frames:{frames}",
                     "--camera-file", APPARATUS / "synthetic_camera.yaml",
                     "--effector", APPARATUS / "effector.toml", "--out", self.folder / "e.toml"]
        run = self.heft(*arguments)
        self.assertEqual(run.returncode, 1)
        self.assertIn("0 picture(s) show two or more", run.stderr)
        self.assertIn("tag 30, 31, 32, 33, 34", run.stderr)
        self.assertFalse((self.folder / "e.toml").exists())
        subprocess.run(["pdftoppm", "-r", "60", "-f", "1", "-singlefile", "-png", pdf,
                        frames / "a"], check=True)
        run = self.heft(*arguments)
        self.assertEqual(run.returncode, 1)
        self.assertIn("640 x 480", run.stderr)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        HEFT = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()

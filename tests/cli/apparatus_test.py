"""The commands heft validate, sheet and calibrate with boards and effectors.

Run as: python3 tests/cli/apparatus_test.py PATH_TO_HEFT
"""

import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

APPARATUS = pathlib.Path(__file__).resolve().parents[2] / "protocols" / "apparatus"
HEFT = "heft"


PIXELS_PER_M = 45 / 0.0254  # of the sheet, as pdftoppm draws it below


def read_gray(path):
    header, pixels = path.read_bytes().split(b"\n255\n", 1)
    width, height = map(int, header.split()[1:3])
    return width, height, pixels


def gray_between(sheet, x, y):
    """Bilinear; white beyond the sheet's edges."""
    width, height, pixels = sheet
    left, top = math.floor(x), math.floor(y)
    if not (0 <= left < width - 1 and 0 <= top < height - 1):
        return 235
    at = top * width + left
    x -= left
    y -= top
    above = pixels[at] * (1 - x) + pixels[at + 1] * x
    below = pixels[at + width] * (1 - x) + pixels[at + width + 1] * x
    return 20 + 0.84 * (above * (1 - y) + below * y)


def unit(v):
    return tuple(c / math.hypot(*v) for c in v)


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def photograph(sheet, around, tilt, distance_m, width=480, height=360, focal=400):
    """What a pinhole camera sees that looks at the sheet's middle, `tilt` radians off its normal."""
    out = (math.sin(tilt) * math.cos(around), math.sin(tilt) * math.sin(around), math.cos(tilt))
    across = unit((out[2], 0, -out[0]))  # level with the sheet's lower edge
    down = cross(across, out)
    picture = bytearray()
    for v in range(height):
        for u in range(width):
            right = (u - width / 2 + 0.5) / focal
            low = (v - height / 2 + 0.5) / focal
            ray = [right * a + low * d - o for a, d, o in zip(across, down, out)]
            way = -distance_m * out[2] / ray[2]
            x = distance_m * out[0] + way * ray[0]
            y = distance_m * out[1] + way * ray[1]
            picture.append(round(gray_between(sheet, sheet[0] / 2 + x * PIXELS_PER_M,
                                              sheet[1] / 2 - y * PIXELS_PER_M)))
    return b"P5 %d %d 255\n" % (width, height) + bytes(picture)


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

    def calibrate_camera(self, source, *more):
        out = self.folder / "camera.yaml"
        run = self.heft("calibrate", "camera", "--camera", source,
                        "--board", APPARATUS / "board.toml", "--out", out, *more)
        self.assertFalse(out.exists())
        return run

    def test_calibrating_needs_a_camera(self):
        run = self.calibrate_camera("camera:97")
        self.assertEqual((run.returncode, run.stdout), (4, ""))
        self.assertEqual(self.calibrate_camera("webcam:0").returncode, 2)

    def test_the_displays_delay_needs_a_camera_that_looks_at_it(self):
        run = self.heft("doctor", "--latency")
        self.assertEqual(run.returncode, 2)
        self.assertIn("--tracker camera:0", run.stderr)
        self.assertEqual(self.heft("doctor", "--latency", "--tracker", "camera:97").returncode, 4)

    def test_calibrating_once_more_keeps_the_earlier_file(self):
        _, pdf = self.sheet("board")
        subprocess.run(["pdftoppm", "-r", "45", "-f", "1", "-singlefile", "-gray", pdf,
                        self.folder / "sheet"], check=True)
        sheet = read_gray(self.folder / "sheet.pgm")
        frames = self.folder / "frames"
        frames.mkdir()
        for i in range(6):
            (frames / f"{i}.pgm").write_bytes(photograph(sheet, 1.1 * i, 0.45, 0.34 + 0.02 * i))
        out = self.folder / "camera.yaml"
        arguments = ["calibrate", "camera", "--camera", f"frames:{frames}", "--size", "480x360",
                     "--board", APPARATUS / "board.toml", "--out", out]
        run = self.heft(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("is kept as", run.stderr)
        first = out.read_bytes()
        self.assertNotIn(b"exposure_s", first)  # nobody knows what pictures were taken with
        focal = float(re.search(rb"data: \[ ([\d.]+),", first)[1])
        self.assertAlmostEqual(focal, 400, delta=8)

        out.write_text("of last week")
        run = self.heft(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(f"is kept as {out}.before\n", run.stderr)
        self.assertEqual(out.read_bytes(), first)
        self.assertEqual(pathlib.Path(f"{out}.before").read_text(), "of last week")
        run = self.heft(*arguments)
        self.assertIn(f"is kept as {out}.before2\n", run.stderr)
        self.assertEqual(pathlib.Path(f"{out}.before").read_text(), "of last week")
        self.assertEqual(pathlib.Path(f"{out}.before2").read_bytes(), first)

    def test_calibrating_looks_at_its_options_before_the_work(self):
        frames = self.folder / "frames"
        frames.mkdir()
        (frames / "a.pgm").write_bytes(b"P5 64 48 255\n" + bytes(64 * 48))
        source = f"frames:{frames}"
        for more, code, message in (
            (("--size", "1280"), 2, "expected width and height in pixels, as in 1280x720"),
            (("--size", "0x0"), 2, "as in 1280x720"),
            (("--size", "1280x720"), 1, "gives pictures of 64 x 48 pixels; omit --size"),
            (("--exposure-ms", "400"), 2, "expected 0.1 to 100 ms"),
            (("--exposure-ms", "nan"), 2, "expected 0.1 to 100 ms"),
            (("--exposure-ms", "4"), 2, "it sets live cameras only"),
        ):
            run = self.calibrate_camera(source, *more)
            self.assertEqual((run.returncode, run.stdout), (code, ""), run.stderr)
            self.assertIn(message, run.stderr)
        run = self.heft("calibrate", "camera", "--camera", "camera:97", "--board",
                        APPARATUS / "board.toml", "--out", self.folder / "missing" / "camera.yaml")
        self.assertEqual(run.returncode, 1)
        self.assertIn("check that its folder exists", run.stderr)

    def test_calibrating_needs_different_views(self):
        _, pdf = self.sheet("board")
        frames = self.folder / "frames"
        frames.mkdir()
        for name in "abcdefgh":
            subprocess.run(["pdftoppm", "-r", "60", "-f", "1", "-singlefile", "-png", pdf,
                            frames / name], check=True)
        run = self.calibrate_camera(f"frames:{frames}")
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertIn("of 8 pictures 1 were kept; 7 are too similar to one", run.stderr)
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
        self.assertIn("the picture is dark (median 0 of 255)", run.stderr)

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
        self.assertIn("are clear in 0 pictures", run.stderr)
        self.assertIn("too rarely beside another tag: 30, 31, 32, 33, 34", run.stderr)
        self.assertFalse((self.folder / "e.toml").exists())
        on_board = self.heft(*arguments, "--on-board", "--board", APPARATUS / "board.toml")
        self.assertEqual((on_board.returncode, on_board.stdout), (1, ""))
        self.assertIn("of 1 picture 0 were kept; 1 do not show a tag of the effector clearly; "
                      "stand it on the board", on_board.stderr)
        for more, message in ((["--on-board"], "--on-board needs --board"),
                              (["--board", APPARATUS / "board.toml"], "--board requires --on-board")):
            run = self.heft(*arguments, *more)
            self.assertEqual(run.returncode, 2)
            self.assertIn(message, run.stderr)
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

"""`heft track` from outside: pictures drawn here, pixel by pixel, of tags seen straight on, so that
the pose follows from similar triangles.

Run as: python3 track_test.py PATH_TO_HEFT
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

HEFT = "heft"
WIDTH, HEIGHT, FOCAL = 320, 240, 400
CELL = 10  # pixels
COLUMNS = ("frame,t_s,board_found,effector_found,x_m,y_m,z_m,qw,qx,qy,qz,camera_x_m,camera_y_m,"
           "camera_z_m,camera_qw,camera_qx,camera_qy,camera_qz,n_tags,reprojection_px,quality,"
           "effector_t_s")
# tag36h11, id 0: code 0xd7e00984b, white cells as dots.
TAG_0 = ["..........",
         ".########.",
         ".#..#.#.#.",
         ".##...#.#.",
         ".##..####.",
         ".#.#.####.",
         ".##.#..##.",
         ".####.###.",
         ".########.",
         ".........."]


def picture(left, top, cell=CELL):
    """A tag whose quiet zone starts at this pixel, on gray."""
    rows = [bytearray([128] * WIDTH) for _ in range(HEIGHT)]
    for y in range(10 * cell):
        for x in range(10 * cell):
            rows[top + y][left + x] = 230 if TAG_0[y // cell][x // cell] == "." else 30
    return b"P5 %d %d 255\n" % (WIDTH, HEIGHT) + b"".join(rows)


CAMERA = (f"%YAML:1.0\n---\nimage_width: {WIDTH}\nimage_height: {HEIGHT}\n"
          "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
          f"   data: [ {FOCAL}, 0, 159.5, 0, {FOCAL}, 119.5, 0, 0, 1 ]\n"
          "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
          "   data: [ 0, 0, 0, 0, 0 ]\n")
BOARD = ('family = "tag36h11"\n[grid]\ncolumns = 1\nrows = 1\ntag_m = 0.08\npitch_m = 0.1\n'
         "first_id = 0\n")


class Track(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write("camera.yaml", CAMERA)
        self.write("board.toml", BOARD)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def track(self, *frames, camera="camera.yaml", board="board.toml"):
        return subprocess.run([HEFT, "track", "--camera-file", str(self.folder / camera), "--board",
                               str(self.folder / board), *frames],
                              capture_output=True, text=True, timeout=120)

    def rows(self, *frames):
        run = self.track(*frames)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout.splitlines()[0], COLUMNS)
        return list(csv.DictReader(run.stdout.splitlines()))

    def test_a_tag_seen_straight_on(self):
        # Its border is 80 pixels wide, and its middle on the optical axis.
        row, = self.rows(self.write("a.pgm", picture(110, 70)))
        self.assertEqual(row["board_found"], "1")
        self.assertEqual(row["effector_found"], "0")
        self.assertEqual(row["x_m"], "")
        self.assertEqual(row["n_tags"], "1")
        self.assertAlmostEqual(float(row["camera_x_m"]), 0, delta=0.0003)
        self.assertAlmostEqual(float(row["camera_y_m"]), 0, delta=0.0003)
        self.assertAlmostEqual(float(row["camera_z_m"]), FOCAL * 0.08 / 80, delta=0.002)
        # The board's y points up in the picture, its z at the camera: half a turn about x.
        self.assertGreater(abs(float(row["camera_qx"])), 0.999)
        self.assertLess(float(row["reprojection_px"]), 0.2)
        # One tag from straight ahead: two tilts fit equally well, and without other tags to determine
        # the edge bias, its distance is uncertain by more than half a millimeter.
        self.assertGreater(float(row["quality"]), 0.1)
        self.assertLess(float(row["quality"]), 0.4)

    def test_it_moves_with_the_picture(self):
        files = [self.write(f"{i}.pgm", picture(110 + 20 * i, 70 - 10 * i)) for i in range(3)]
        rows = self.rows(*files, "--rate", "10")
        self.assertEqual([row["frame"] for row in rows], ["0", "1", "2"])
        self.assertEqual([float(row["t_s"]) for row in rows], [0, 0.1, 0.2])
        for i, row in enumerate(rows):
            z = float(row["camera_z_m"])
            self.assertAlmostEqual(float(row["camera_x_m"]), 20 * i / FOCAL * z, delta=0.0005)
            self.assertAlmostEqual(float(row["camera_y_m"]), -10 * i / FOCAL * z, delta=0.0005)

    def test_a_folder_and_a_picture_without_a_board(self):
        gray = b"P5 %d %d 255\n" % (WIDTH, HEIGHT) + bytes([128]) * (WIDTH * HEIGHT)
        self.write("frames/f1.pgm", picture(110, 70))
        self.write("frames/f2.pgm", gray)
        self.write("frames/f10.pgm", picture(60, 70))
        rows = self.rows(str(self.folder / "frames"))
        self.assertEqual([row["board_found"] for row in rows], ["1", "0", "1"])
        self.assertEqual(rows[1]["camera_x_m"], "")
        self.assertEqual(rows[1]["n_tags"], "0")
        self.assertEqual(rows[1]["reprojection_px"], "")

    def test_a_damaged_picture_has_a_row_and_is_named(self):
        good = [self.write(f"frames/{i}.pgm", picture(110, 70)) for i in (1, 3)]
        bad = self.write("frames/2.pgm", "no picture")
        for frames in ([good[0], bad, good[1]], [str(self.folder / "frames")]):
            run = self.track(*frames)
            self.assertEqual(run.returncode, 1)
            rows = list(csv.DictReader(run.stdout.splitlines()))
            self.assertEqual([row["frame"] for row in rows], ["0", "1", "2"])
            self.assertEqual([row["board_found"] for row in rows], ["1", "0", "1"])
            self.assertEqual((rows[1]["camera_x_m"], rows[1]["n_tags"]), ("", "0"))
            self.assertAlmostEqual(float(rows[1]["t_s"]), 1 / 30, delta=1e-9)
            self.assertIn("2.pgm", run.stderr)
            self.assertIn("1 of 3 pictures", run.stderr)

    def test_help_says_whose_the_columns_are(self):
        run = subprocess.run([HEFT, "track", "--help-all"], capture_output=True, text=True, timeout=60)
        for word in ("n_tags, reprojection_px and quality are the effector's", "unfiltered"):
            self.assertIn(word, run.stdout)

    def refused(self, code, *words, run):
        self.assertEqual(run.returncode, code, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertNotIn("error of heft itself", run.stderr)

    def test_refusals(self):
        frame = self.write("a.pgm", picture(110, 70))
        small = self.write("small.pgm", b"P5 20 10 255\n" + bytes(200))
        text = self.write("text.pgm", "no picture")
        self.write("bad.yaml", CAMERA.replace("400, 0, 159.5", "-400, 0, 159.5"))
        self.refused(1, "small.pgm", "20 x 10", "320 x 240", run=self.track(small))
        self.refused(1, "text.pgm", run=self.track(text))
        self.refused(1, "absent.pgm", run=self.track(str(self.folder / "absent.pgm")))
        self.refused(3, "bad.yaml", "-400", run=self.track(frame, camera="bad.yaml"))
        self.refused(3, "camera.yaml", run=self.track(frame, board="camera.yaml"))
        self.refused(1, "absent.yaml", run=self.track(frame, camera="absent.yaml"))
        self.refused(2, "FRAMES", run=self.track())
        self.refused(2, "--rate", run=self.track(frame, "--rate", "0"))


if __name__ == "__main__":
    HEFT = sys.argv.pop(1)
    unittest.main()

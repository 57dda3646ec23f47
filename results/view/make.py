"""The picture of the participant's screen in README.md, from a session in a window that nobody looks at.

Run: python3 results/view/make.py   (needs Xvfb, xdotool and ImageMagick's import)
"""
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))
sys.argv = [sys.argv[0], str(ROOT / "build" / "heft")]
from window_test import HEFT, Person, Screen  # noqa: E402

PICTURE = ROOT / "results" / "view" / "sorting.png"
PUSHING_S = 2.0  # after the cubes appear, with this seed


def main():
    screen = Screen()
    with tempfile.TemporaryDirectory() as folder:
        db = str(Path(folder) / "view.db")
        program = subprocess.Popen(
            [HEFT, "run", str(ROOT / "protocols" / "quick.toml"), "--participant", "picture",
             "--db", db, "--seed", "8", "--purpose", "test", "--tracker", "synthetic"],
            env=screen.environment(), stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        person = Person(screen, db, program)
        while not person.log("select 1 from trial where task = 'sorting' and shown_s > 0 and "
                             "condition = 'C2' and status = 'open'"):
            person.take_part(0.3)
        time.sleep(PUSHING_S)
        subprocess.run(["import", "-window", "root", "-colors", "200", "+dither", str(PICTURE)],
                       env=screen.environment(), check=True)
        program.terminate()
        program.wait()
    screen.close()


if __name__ == "__main__":
    main()

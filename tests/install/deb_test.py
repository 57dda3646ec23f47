"""The Debian packages, made by cpack, installed by apt in a minimal Debian root, and run.

Needs root and a network (debootstrap); takes some minutes. Run: python3 deb_test.py BUILD_FOLDER
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD = Path(sys.argv.pop(1)).resolve()
MIRROR = "http://deb.debian.org/debian"


def must(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout[-3000:]}\n"
                             f"{done.stderr[-3000:]}")
    return done.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.root = cls.folder / "root"
        must("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder)
        cls.debs = {path.name.split("_")[0]: path for path in cls.folder.glob("*.deb")}
        must("debootstrap", "--variant=minbase", "bookworm", cls.root, MIRROR)

    def field(self, package, name):
        return must("dpkg-deb", "-f", self.debs[package], name)

    def installed(self, package):
        shutil.copy(self.debs[package], self.root)
        must("chroot", self.root, "apt-get", "install", "-y", "--no-install-recommends",
             "-o", "APT::Sandbox::User=root", f"/{self.debs[package].name}")

    def heft(self, *words):
        done = subprocess.run(["chroot", self.root, "heft", *words], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def works(self, *words):
        code, output = self.heft(*words)
        self.assertEqual(code, 0, f"{words}: {output}")
        return output

    def test_1_dependencies(self):
        self.assertEqual(set(self.debs), {"heft", "heft-bench", "libheft-dev", "python3-heft"})
        needs = self.field("heft", "Depends")
        for library in ("libc6", "libbullet", "libsqlite3", "libsdl2", "libopencv-core", "dejavu"):
            self.assertIn(library, needs)
        for none in ("-dev", "libode", "libgtest"):
            self.assertNotIn(none, needs)
        self.assertIn("libode", self.field("heft-bench", "Depends"))
        self.assertIn("heft (=", self.field("heft-bench", "Depends"))
        for package in ("heft (=", "python3-pandas", "python3 (<<", "libsqlite3"):
            self.assertIn(package, self.field("python3-heft", "Depends"))
        for library in ("opencv", "bullet", "sdl"):
            self.assertNotIn(library, self.field("python3-heft", "Depends"))
        for library in ("bullet", "nlopt"):
            self.assertNotIn(library, self.field("libheft-dev", "Depends"))
        library = must("dpkg-deb", "-c", self.debs["libheft-dev"])
        for file in ("psychophysics/UpDown.h", "libheft_psychophysics.a", "heft-config.cmake"):
            self.assertIn(file, library)

    def test_2_heft_runs_in_a_clean_root(self):
        self.installed("heft")
        self.assertRegex(self.works("--version"), r"^heft \d+\.\d+")
        protocols = "/usr/share/heft/protocols"
        self.works("validate", f"{protocols}/paper.toml", f"{protocols}/quick.toml")
        self.works("simulate", f"{protocols}/jnd.toml", "--participants", "2", "--seed", "1",
                   "--db", "/tmp/lab.db")
        self.works("run", f"{protocols}/quick.toml", "--participant", "1", "--responder",
                   "simulated", "--tracker", "synthetic", "--db", "/tmp/lab.db")
        self.assertIn("verified", self.works("replay", "--db", "/tmp/lab.db"))
        self.assertIn('"simulated": true', self.works("analyse", "--db", "/tmp/lab.db", "--mix",
                                                      "--json"))

    def test_3_the_python_module(self):
        self.installed("python3-heft")
        code = ("import heft; protocol = '/usr/share/heft/protocols/jnd.toml';"
                "print(len(heft.read_log(heft.simulate(protocol, 1, 1, '/tmp/py.db'))['trial']));"
                "print(heft.Procedure({'kind': 'up_down', 'start': 5, 'step': 1}).level)")
        said = must("chroot", self.root, "python3", "-c", code)
        self.assertRegex(said, r"^[1-9]\d+\n5.0\n$")

    def test_4_the_studies_are_a_separate_package(self):
        code, said = self.heft("bench", "--help")
        self.assertEqual(code, 1)
        self.assertIn("heft-bench", said)
        self.installed("heft-bench")
        self.assertIn("physics", self.works("bench", "--help"))


if __name__ == "__main__":
    unittest.main()

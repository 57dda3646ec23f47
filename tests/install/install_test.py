"""The installed tree: its programs run after it is moved, a copied program finds its files, and
external CMake projects find the libraries.

Run: python3 install_test.py CMAKE BUILD_FOLDER COMPILER_FLAGS
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CMAKE, BUILD, FLAGS = (sys.argv.pop(1) for _ in range(3))
HERE = Path(__file__).resolve().parent
# The environment of an installed program, without the build's variables.
BARE = {"PATH": "/usr/bin:/bin", "HOME": "/nonexistent"}


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          **options)


class Installed(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(dir=BUILD)))

    def must(self, *command, **options):
        done = run(*command, **options)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
        return done

    def install(self, *options):
        prefix = self.folder / "prefix"
        self.must(CMAKE, "--install", BUILD, "--prefix", prefix, *options)
        return prefix.rename(self.folder / "moved")

    def consumer(self, prefix, *components):
        return run(CMAKE, "-S", HERE, "-B", self.folder / "build", f"-DCMAKE_PREFIX_PATH={prefix}",
                   f"-DCMAKE_CXX_FLAGS={FLAGS}", f"-DHEFT_COMPONENTS={';'.join(components)}")


class Programs(Installed):
    def test_run_after_a_move_and_find_their_files(self):
        prefix = self.install("--component", "heft")
        heft, db = prefix / "bin/heft", self.folder / "lab.db"
        protocols = prefix / "share/heft/protocols"
        self.assertIn(".SS heft run", (prefix / "share/man/man1/heft.1").read_text())
        for completion in ("bash-completion/completions/heft", "zsh/vendor-completions/_heft",
                           "fish/vendor_completions.d/heft.fish"):
            self.assertTrue((prefix / "share" / completion).exists(), completion)
        self.assertRegex(self.must(heft, "--version", env=BARE).stdout, r"^heft \d+\.\d+\.\d+")
        self.must(heft, "validate", *sorted(protocols.glob("*.toml")), env=BARE)
        self.must(heft, "simulate", protocols / "jnd.toml", "--participants", 1, "--seed", 1,
                  "--db", db, env=BARE)
        self.must(heft, "replay", "--db", db, env=BARE)
        self.must(heft, "export", "--db", db, "--out", self.folder / "data", env=BARE)
        self.assertIn("read_table", (self.folder / "data/analysis.R").read_text())
        # Texts that exist only in the installed tree.
        shutil.copy(protocols / "texts/en.toml", protocols / "texts/own.toml")
        self.must(heft, "run", protocols / "quick.toml", "--participant", "1", "--db", db,
                  "--responder", "simulated", "--language", "own", env=BARE)

    def test_a_missing_codecs_module_is_named(self):
        prefix = self.install("--component", "heft")
        filming = [prefix / "bin/heft", "run", prefix / "share/heft/protocols/quick.toml",
                   "--participant", "1", "--responder", "simulated"]
        film, module = self.folder / "film.avi", next(prefix.rglob("heft-codecs.so"))
        self.must(*filming, "--db", self.folder / "lab.db", "--view", f"video:{film}", env=BARE)
        self.assertGreater(film.stat().st_size, 10_000)
        module.unlink()
        without = run(*filming, "--db", self.folder / "no.db", "--view",
                      f"video:{self.folder / 'none.avi'}", env=BARE)
        self.assertEqual(without.returncode, 1, without.stderr)
        self.assertIn("heft-codecs.so", without.stderr)

    def test_a_missing_window_module_is_named(self):
        prefix = self.install("--component", "heft")
        checking = [prefix / "bin/heft", "doctor", "--db", self.folder / "lab.db"]
        showing = [prefix / "bin/heft", "run", prefix / "share/heft/protocols/quick.toml",
                   "--participant", "1", "--tracker", "mouse", "--view", "window", "--db",
                   self.folder / "lab.db"]
        self.assertIn("none: sessions with a window need a desktop", run(*checking, env=BARE).stdout)
        self.assertEqual(run(*showing, env=BARE).returncode, 4)
        next(prefix.rglob("heft-window.so")).unlink()
        for command in (checking, showing):
            without = run(*command, env=BARE)
            self.assertEqual(without.returncode, 1, without.stderr)
            self.assertIn("heft-window.so", without.stdout + without.stderr)

    @unittest.skipIf("-fsanitize" in FLAGS, "sanitizers link the modules' OpenCV libraries into the program")
    def test_a_start_loads_no_library_of_a_module(self):
        libraries = run("ldd", Path(BUILD) / "heft").stdout
        self.assertIn("libsqlite3", libraries)
        for name in ("imgcodecs", "videoio", "SDL", "libGL.so", "pulse"):
            self.assertNotIn(name, libraries)

    def test_bench_is_found_beside_in_libexec_or_on_the_path(self):
        prefix = self.install()
        heft, bench = prefix / "bin/heft", prefix / "bin/heft-bench"
        for place in (prefix / "bin", prefix / "libexec/heft", self.folder / "elsewhere"):
            place.mkdir(parents=True, exist_ok=True)
            bench = bench.rename(place / "heft-bench")
            path = dict(BARE, PATH=f"{self.folder / 'elsewhere'}:{BARE['PATH']}")
            self.assertIn("pipeline", self.must(heft, "bench", "--help", env=path).stdout)
        wrong = run(heft, "bench", "phisics", env=path)
        self.assertEqual(wrong.returncode, 2, wrong.stderr)
        self.assertIn("did you mean physics", wrong.stderr)
        bench.unlink()
        for words, code in ((["bench", "physics"], 1),
                            (["scene", "S.toml", "--trajectory", "T.csv", "--simulator",
                              "bullet-spring2"], 2)):
            without = run(heft, *words, env=BARE)
            self.assertEqual(without.returncode, code, without.stderr)
            self.assertIn("heft-bench", without.stderr)
            self.assertIn("./heft bench", without.stderr)

    def test_a_program_copied_out_of_its_build_folder_runs(self):
        heft = shutil.copy(Path(BUILD) / "heft", self.folder)
        self.must(heft, "run", HERE.parent.parent / "protocols/quick.toml", "--participant", "1",
                  "--db", self.folder / "lab.db", "--responder", "simulated", env=BARE)

    def test_heft_does_not_link_what_only_the_studies_need(self):
        libraries = {program: run("ldd", Path(BUILD) / program).stdout
                     for program in ("heft", "heft-bench")}
        self.assertNotIn("libode", libraries["heft"])
        self.assertNotIn("aruco", libraries["heft"])
        symbols = run("nm", "-C", Path(BUILD) / "heft").stdout
        held = {name for name in ("boxes::BoxWorld", "StockWorld", "ComparisonTracker",
                                  "run_physics_study", "make_ode_simulator") if name in symbols}
        self.assertEqual(held, {"boxes::BoxWorld"})


class Libraries(Installed):
    def build_and_run(self, prefix, *components):
        found = self.consumer(prefix, *components)
        self.assertEqual(found.returncode, 0, found.stderr)
        self.must(CMAKE, "--build", self.folder / "build")
        self.assertRegex(self.must(self.folder / "build/consumer").stdout,
                         r"threshold: 6[0-9]\.[0-9]+ g")

    def test_psychophysics_alone_installs_no_physics(self):
        prefix = self.install("--component", "psychophysics")
        self.assertEqual([path.name for path in prefix.rglob("*.a")].count("libheft_physics.a"), 0)
        self.build_and_run(prefix, "psychophysics")

    def test_all_components_link(self):
        prefix = self.install()
        components = [name for name in ("psychophysics", "inference", "engine", "physics")
                      if list(prefix.rglob(f"libheft_{name}.a"))]
        self.assertLessEqual({"physics", "inference"}, set(components))
        self.build_and_run(prefix, *components)
        self.assertRegex(self.must(self.folder / "build/fit").stdout,
                         r"75 % correct at \d+\.\d g, 95 % interval \d+\.\d to \d+\.\d g")
        self.assertRegex(self.must(self.folder / "build/own_session").stdout, r"own: 6[0-9]")

    def test_a_missing_component_is_named(self):
        prefix = self.install("--component", "psychophysics")
        missing = self.consumer(prefix, "physics")
        self.assertNotEqual(missing.returncode, 0)
        self.assertIn("component physics is not installed", " ".join(missing.stderr.split()))


if __name__ == "__main__":
    unittest.main()

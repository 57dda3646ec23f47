"""Every command of the READMEs: run where that is possible, otherwise its options are looked up.

Each README is followed from top to bottom in a folder of its own, with the shipped protocols and a log of simulated
participants. What needs a person, a camera or minutes of building is not run; its options must exist.

Run: python3 tests/cli/readme_test.py PATH_TO_HEFT
"""
import os
import re
import shlex
import shutil
import sqlite3
import subprocess
import sys

from session_harness import PROTOCOLS, SessionTest, main

ROOT = PROTOCOLS.parent
READMES = ["README.md", "protocols/README.md", "protocols/apparatus/README.md", "src/README.md",
           "src/record/README.md", "src/analysis/README.md"]
# Whole lines that are not run, nor looked up: they build, install or take the network.
NOT_HEFT = re.compile(r"^(\./heft (demo|test)|HEFT_KILLS|RC_PARAMS|cmake|ctest|\(cd build)")
# Not run, as they wait for a person or a device.
NEEDS_SOMEBODY = re.compile(r"camera:\d|--tracker mouse|--plan|calibrate|^\S*heft (run|resume) "
                            r"(?!.*--responder)|udp:")


def blocks(text, language):
    return re.findall(rf"^( *)```{language}\n(.*?)^ *```$", text, re.M | re.S)


def commands(text):
    """The lines of all shell blocks, continued lines joined, without comments."""
    for indent, block in blocks(text, "sh"):
        for line in re.sub(r"\\\n\s*", "", block).splitlines():
            line = re.sub(r"\s+# .*", "", line).strip()
            if line and not line.startswith("#"):
                yield line


class Readmes(SessionTest):
    def follow(self, name):
        (self.folder / "protocols").symlink_to(ROOT / "protocols")
        shutil.copy(PROTOCOLS / "quick.toml", self.folder / "paper.toml")
        self.run_heft("simulate", PROTOCOLS / "paper.toml", "--participants", "2", "--seed", "1", "--db",
                      self.folder / "lab.db")
        text = (ROOT / name).read_text(encoding="utf-8")
        for file, content in re.findall(r"Save this as `([^`]+)`:\n\n```toml\n(.*?)```", text, re.S):
            (self.folder / file).write_text(content, encoding="utf-8")
        n_run = 0
        for line in commands(text):
            with self.subTest(line=line):
                n_run += self.obey(line)
        return n_run + self.run_recipes(text)

    def run_recipes(self, text):
        """Runs the blocks in SQL, each alone, and those in Python and R, each as one script."""
        with sqlite3.connect(self.folder / "lab.db") as db:
            for _, block in blocks(text, "sql"):
                with self.subTest(sql=block):
                    self.assertTrue(db.execute(block).fetchall(), "no rows")
        n_run = len(blocks(text, "sql"))
        for language, command, probe in (
                ("python", [sys.executable, "-c"], "import pandas"),
                ("r", ["Rscript", "-e"], "library(RSQLite)")):
            script = "".join(block for _, block in blocks(text, language))
            if not script or shutil.which(command[0]) is None:
                continue
            if subprocess.run([*command, probe], capture_output=True).returncode == 0:
                done = subprocess.run([*command, script], cwd=self.folder, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                n_run += len(blocks(text, language))
        return n_run

    def obey(self, line):
        """Runs one line, or looks its options up. @return whether it was run"""
        if NOT_HEFT.search(line):
            return False
        words = shlex.split(line)
        if words[0] == "sqlite3":
            with sqlite3.connect(self.folder / "lab.db") as db:
                self.assertTrue(db.execute(words[-1]).fetchall(), "no rows")
            return True
        if words[0] == "cp":
            if "protocols/mine" in words:
                return False  # the shipped folder stays as it is
            subprocess.run(words, cwd=self.folder, check=True)
            return True
        if words[0] == "(cd":
            if shutil.which("Rscript") is None:
                return False
            subprocess.run(line, shell=True, cwd=self.folder, check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
            return True
        self.assertIn(words[0], ("./heft", "heft"))
        words = words[1:]
        if "protocols/mine/STUDY.toml" in words:
            words[words.index("protocols/mine/STUDY.toml")] = "protocols/examples/STUDY.toml"
        if NEEDS_SOMEBODY.search(line):
            names = [word for word in words[:2] if re.fullmatch("[a-z]+", word)]
            known = self.run_heft(*names, "--help").stdout
            for word in words:
                if word.startswith("--"):
                    self.assertIn(word, known)
            return False
        done = subprocess.run([self.heft, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return True


def following(name, least):
    def test(self):
        self.assertGreaterEqual(self.follow(name), least)
    return test


for readme, least_run in zip(READMES, (5, 5, 2, 0, 6, 0)):
    setattr(Readmes, "test_" + re.sub(r"\W", "_", readme), following(readme, least_run))


class Links(SessionTest):
    def test_every_link_leads_somewhere(self):
        for name in READMES:
            text = (ROOT / name).read_text(encoding="utf-8")
            for target in re.findall(r"\]\((?!http)([^)#]+)\)", text):
                self.assertTrue(((ROOT / name).parent / target).exists(), f"{name}: {target}")

    def test_the_first_readme_is_short(self):
        self.assertLessEqual(os.path.getsize(ROOT / "README.md"), 8192)


if __name__ == "__main__":
    main(__name__)

"""The report printed by a browser: A4, every figure and table complete, no page empty. Exits with 77
without Chromium and poppler (Debian: chromium, poppler-utils).

Run: python3 tests/studies/report_pdf.py PATH_TO_HEFT [KEEP_PDF_AS]
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROTOCOL = Path(__file__).resolve().parents[2] / "protocols" / "recommended.toml"


def run(*words, **options):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, **options)
    if done.returncode:
        raise SystemExit(f"{words}: {done.stderr}")
    return done.stdout


def main():
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if not browser or not shutil.which("pdfinfo"):
        print("chromium or poppler-utils is not here")
        raise SystemExit(77)
    heft = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(heft, "simulate", PROTOCOL, "--participants", 5, "--seed", 9, "--db", folder / "lab.db")
        run(heft, "analyse", "--db", folder / "lab.db", "--out", folder / "report")
        pdf = folder / "report.pdf"
        run(browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
            f"--user-data-dir={folder / 'browser'}", f"--print-to-pdf={pdf}",
            folder / "report" / "report.html", timeout=240)
        info, text = run("pdfinfo", pdf), run("pdftotext", "-layout", pdf, "-")
        html = re.sub("<nav>.*?</nav>", "", (folder / "report" / "report.html").read_text(),
                      flags=re.DOTALL)  # links, which paper has not
        files = json.loads((folder / "report" / "summary.json").read_text())["files"]
        if len(sys.argv) > 2:
            shutil.copy(pdf, sys.argv[2])
    wrong = []
    size = re.search(r"Page size:\s+([\d.]+) x ([\d.]+)", info).groups()
    if [round(float(points) / 72 * 25.4) for points in size] != [210, 297]:
        wrong.append(f"not A4: {size}")
    pages = text.split("\f")[:-1]
    for number, page in enumerate(pages, 1):
        if not page.strip():
            wrong.append(f"page {number} is empty")
    printed = " ".join(text.split())
    figures = [int(n) for n in re.findall(r"Figure (\d+)\.", printed)]
    n_charts = sum(file.endswith(".svg") for file in files)
    if sorted(set(figures)) != list(range(1, n_charts + 1)):
        wrong.append(f"figures {figures} of {n_charts}")
    for heading in re.findall(r"<h[123][^>]*>([^<]+)</h[123]>", html):
        words = heading.replace("&amp;", "&").replace("&quot;", '"').replace("&#39;", "'")
        if " ".join(words.split()) not in printed:
            wrong.append(f"not printed: {words}")
    print(f"{len(pages)} pages of A4, {n_charts} figures", *wrong, sep="\n  ")
    raise SystemExit(1 if wrong else 0)


if __name__ == "__main__":
    main()

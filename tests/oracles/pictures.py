"""Pictures as other programs see them: the fonts and the text of PDFs by poppler (pdffonts, pdftotext), the XML of SVGs."""
import os
import subprocess
import tempfile
import xml.etree.ElementTree as tree

KINDS = {
    "points": ["--generate", "sobol", "-n", 64],
    "words that Latin letters do not have": ["--generate", "random", "-n", 9, "--title", "Größe χ² ≤ 10⁻³ λ π ★"],
    "space": ["--generate", "random", "-n", 64, "-d", 3],
    "pairs": ["--generate", "random", "-n", 64, "-d", 5],
    "histogram": ["--generate", "random", "-n", 64, "-d", 2, "--chart", "histogram"],
    "overlay": ["--generate", "random", "--generate", "halton", "-n", 64, "--overlay"],
    "sheet": ["--generate", "random", "--generate", "halton", "--generate", "sobol", "-n", 64],
    "radial": ["--generate", "random", "-n", 64, "--chart", "radial"],
    "spectrum": ["--generate", "random", "-n", 64, "--chart", "spectrum"],
    "density": ["--generate", "random", "-n", 20000, "--chart", "density"],
    "local discrepancy": ["--generate", "halton", "-n", 64, "--chart", "local-discrepancy"],
    "distances": ["--generate", "random", "-n", 64, "--chart", "distances"],
    "long names": ["--generate", "random", "-n", 64, "--axes", "outer diameter of the cylinder at its end,height"],
}
NAMESPACE = "{http://www.w3.org/2000/svg}"


def drawn(cases, folder, kind, extension):
    path = os.path.join(folder, "picture" + extension)
    cases.run("plot", *KINDS[kind], "-o", path, "--quiet")
    return path


def letters(texts):
    """Letters without blanks (lines are broken there), sorted: readers join lines in different orders."""
    return sorted("".join("".join(texts).split()))


def check_fonts(cases):
    """Fonts of PDFs are embedded, and their text is that of the SVG."""
    with tempfile.TemporaryDirectory() as folder:
        for kind in KINDS:
            pdf = drawn(cases, folder, kind, ".pdf")
            fonts = subprocess.run(["pdffonts", pdf], capture_output=True, text=True, check=True)
            rows = fonts.stdout.splitlines()[2:]
            cases.expect(f"{kind}: no complaints", not fonts.stderr, fonts.stderr)
            cases.expect(f"{kind}: some font", len(rows) > 0)
            for row in rows:
                cases.expect(f"{kind}: embedded, a subset, with its letters", row.split()[-5:-2] == ["yes"] * 3, row)
            text = subprocess.run(["pdftotext", pdf, "-"], capture_output=True, text=True, check=True).stdout
            svg = tree.parse(drawn(cases, folder, kind, ".svg")).getroot()
            wanted = letters(element.text or "" for element in svg.iter(NAMESPACE + "text"))
            found = letters(text)
            cases.expect(f"{kind}: text", found == wanted, f"{''.join(found)} for {''.join(wanted)}")

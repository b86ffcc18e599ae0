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


LONG = "a long name of sixty letters as nobody would give to a series"[:60]
SIZES = [[], ["--width", 400], ["--width", 250], ["--height", 300], ["--width", 1600, "--height", 400]]
NAMED = {
    "plane": ["--generate", "sobol", "-n", 64, "--axes", f"{LONG},{LONG}"],
    "space": ["--generate", "random", "-n", 64, "-d", 3, "--axes", ",".join([LONG] * 3)],
    "pairs": ["--generate", "random", "-n", 64, "-d", 4, "--axes", ",".join([LONG] * 4)],
    "sheet": ["--generate", "random", "--generate", "halton", "-n", 64, "--labels", f"A {LONG},B {LONG}"],
    "overlay": ["--generate", "random", "--generate", "halton", "-n", 64, "--labels", f"A {LONG},B {LONG}", "--overlay"],
    "radial": ["--generate", "random", "--generate", "halton", "-n", 64, "--chart", "radial", "--axes", ",".join([LONG] * 3)],
    "distances": ["--generate", "random", "-n", 64, "--chart", "distances", "--axes", f"{LONG},{LONG}"],
    "local discrepancy": ["--generate", "halton", "-n", 64, "--chart", "local-discrepancy", "--axes", f"{LONG},{LONG}"],
    "spectrum": ["--generate", "random", "-n", 64, "--chart", "spectrum", "--axes", f"{LONG},{LONG}"],
}


def check_texts(cases):
    """Texts of PDFs are on the page (pdftotext -bbox), in all sizes that are not refused."""
    with tempfile.TemporaryDirectory() as folder:
        pdf = os.path.join(folder, "picture.pdf")
        for kind, arguments in NAMED.items():
            for size in SIZES:
                cases.run("plot", *arguments, *size, "--title", LONG + " " + LONG, "-o", pdf, "--quiet")
                text = subprocess.run(["pdftotext", "-bbox", pdf, "-"], capture_output=True, text=True, check=True).stdout
                page = tree.fromstring(text).find(".//{*}page")
                wide, high = float(page.get("width")), float(page.get("height"))
                words = page.findall(".//{*}word")
                cases.expect(f"{kind} {size}: words", len(words) > 10)
                for word in words:
                    left, top, right, bottom = (float(word.get(key)) for key in ("xMin", "yMin", "xMax", "yMax"))
                    cases.expect(f"{kind} {size}: {word.text} is on the page",
                                 left >= 0 and top >= -1 and right <= wide and bottom <= high + 1,
                                 f"{left, top, right, bottom} of {wide, high}")


def check_slopes(cases):
    """Slopes of studies and their standard errors (scipy.stats.linregress)."""
    import csv
    import math

    from scipy.stats import linregress

    with tempfile.TemporaryDirectory() as folder:
        table, svg = os.path.join(folder, "s.csv"), os.path.join(folder, "s.svg")
        cases.run("study", "--generators", "random;halton;sobol:scramble=owen", "-n", "16..1024*2", "--seeds", 4, "--analyze",
                  "star-discrepancy,nearest-neighbor", "--keys", "value,minimum", "-o", table, "--quiet")
        for key in "value", "minimum":
            cases.run("plot", table, "--key", key, "-o", svg, "--quiet")
            texts = [element.text or "" for element in tree.parse(svg).getroot().iter(NAMESPACE + "text")]
            with open(table, newline="") as file:
                rows = [row for row in csv.DictReader(file) if row["key"] == key]
            for name in sorted({row["generator"] for row in rows}):
                values = {}
                for row in rows:
                    if row["generator"] == name:
                        values.setdefault(int(row["count"]), []).append(float(row["value"]))
                fit = linregress([math.log(n) for n in values], [math.log(sum(v) / len(v)) for v in values.values()])
                legend = next((text for text in texts if text.startswith(name) and "slope" in text), "")
                numbers = legend.partition("slope ")[2].rstrip(")").replace("\N{MINUS SIGN}", "-").split(" ± ")
                same = len(numbers) == 2 and all(
                    abs(float(number) - exact) <= 0.5001 * 10.0 ** -len(number.partition(".")[2])
                    for number, exact in zip(numbers, (fit.slope, fit.stderr)))
                cases.expect(f"{key} of {name}", same, f"{legend} for {fit.slope} ± {fit.stderr}")

# SPDX-License-Identifier: MIT
"""What the plotting scripts share: stipple's files in, pictures out, errors as the program does.

    read_reports(path)  -> [Report]    from `stipple analyze` as JSON (also many, end to end) or CSV
    canvas()            -> pyplot with the house style, no display needed
    run(main)           -> main() with exit codes 2 usage, 3 bad input, 4 cannot read or write

A path "-" is standard input. Needs NumPy, and matplotlib for canvas().
"""

import argparse
import csv
import io
import json
import logging
import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

WANTED = "expected the JSON or CSV of 'stipple analyze'"
USAGE, INPUT, IO, LIMIT, INTERRUPTED = 2, 3, 4, 5, 130

# Okabe and Ito's colours: told apart by colour-blind readers, and dark enough for thin lines.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
GREY = "#6b6b6b"
# What is judged beside each other, from the plainest to the most laboured.
BLUE_NOISE = (
    "dart-throwing",
    "best-candidate",
    "poisson-disk",
    "sample-elimination",
    "void-and-cluster",
    "lloyd",
    "farthest-point",
    "capacity-constrained",
    "gaussian-blue-noise",
    "tiled",
)
EXTENSIONS = {".png": "png", ".svg": "svg", ".pdf": "pdf"}


class Refusal(Exception):
    """An error for the user: an exit code and one line."""

    def __init__(self, code, message):
        super().__init__(" ".join(str(message).split()))
        self.code = code


def usage_error(message):
    return Refusal(USAGE, message)


def input_error(message):
    return Refusal(INPUT, message)


def file_error(message):
    return Refusal(IO, message)


# ---------------------------------------------------------------- reading


def name_of(path):
    return "standard input" if path == "-" else path


def read_bytes(path):
    """The bytes of a file, or of standard input for '-'."""
    try:
        if path != "-":
            return Path(path).read_bytes()
        if sys.stdin is None:
            raise file_error("standard input: is closed")
        return sys.stdin.buffer.read()
    except (OSError, ValueError) as error:  # ValueError: a path with a zero byte
        reason = getattr(error, "strerror", None) or error
        raise file_error(f"{name_of(path)}: {reason}") from None


def decode(data, name):
    """The text of bytes, without a byte-order mark."""
    if b"\0" in data:
        raise input_error(f"{name}: is binary; expected text, JSON or npy (see 'stipple convert')")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise input_error(f"{name}: byte {error.start} is not UTF-8 text") from None


def json_documents(text, name):
    """All JSON documents that stand one after the other in a text."""

    def refuse(word):
        raise input_error(f"{name}: holds {word}; numbers must be finite")

    decoder = json.JSONDecoder(parse_constant=refuse)
    documents, at = [], 0
    try:
        while at < len(text):
            if text[at].isspace():
                at += 1
                continue
            document, at = decoder.raw_decode(text, at)
            documents.append(document)
    except json.JSONDecodeError as error:
        where = f"{name}:{error.lineno}:{error.colno}"
        raise input_error(f"{where}: is not whole JSON ({error.msg})") from None
    except RecursionError:
        raise input_error(f"{name}: is JSON too deeply nested") from None
    return documents


def nested(value, depth):
    """Whether it is a list of lists ..., so deep."""
    for _ in range(depth):
        if not isinstance(value, list) or not value:
            return False
        value = value[0]
    return True


def number(word):
    """A number, also an infinite one, or None."""
    try:
        return float(word) if "_" not in word else None
    except ValueError:
        return None


# ---------------------------------------------------------------- reports


@dataclass
class Report:
    """One measurement of `stipple analyze`; keys are dotted, as in `--check`."""

    analyzer: str
    source: str
    count: int
    sets: int
    results: dict
    errors: dict
    file: str
    number: int = None  # of the set in its file
    study: bool = False  # it is from the table of a study

    def find(self, key, errors=False):
        group = self.errors if errors else self.results
        if key in group:
            return group[key]
        for part in key.split("."):
            if not isinstance(group, dict) or part not in group:
                return None
            group = group[part]
        return group

    def value(self, key, errors=False):
        """A finite number, or None."""
        found = self.find(key, errors)
        if isinstance(found, list):
            found = found[0] if found else None
        found = number(found) if isinstance(found, str) else found
        if isinstance(found, bool) or not isinstance(found, (int, float)):
            return None
        return float(found) if np.isfinite(found) else None

    def curve(self, key, errors=False):
        """An array in which gaps are NaN, or None."""
        found = self.find(key, errors)
        if not isinstance(found, list):
            return None
        found = [number(x) if isinstance(x, str) else x for x in found]
        if any(isinstance(x, (bool, list, dict)) for x in found):
            return None
        return np.array([np.nan if x is None else x for x in found], dtype=float)


def read_reports(path):
    """All reports of a file."""
    name, text = name_of(path), decode(read_bytes(path), name_of(path))
    if text.lstrip()[:1] in ("{", "["):
        documents = []
        for document in json_documents(text, name):
            documents += document if isinstance(document, list) else [document]
        reports = [json_report(document, path) for document in documents]
    elif text.startswith("generator,generator_options,"):
        reports = study_reports(text, path)
    else:
        reports = csv_reports(text, path)
    if not reports:
        raise input_error(f"{name}: holds no report")
    return reports


def json_report(document, path):
    name = name_of(path)
    if not isinstance(document, dict) or document.get("format") != "stipple.report":
        raise input_error(f"{name}: is not a report; {WANTED}")
    try:
        given = document["input"]
        return Report(
            analyzer=str(document["analyzer"]),
            source=str(given["source"]),
            count=int(given["count"]),
            sets=int(given.get("sets", 1)),
            results=dict(document["results"]),
            errors=dict(document.get("standard_error", {})),
            file=path,
            number=given.get("set"),
        )
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise input_error(f"{name}: is a report in which {error} is missing or wrong") from None


def csv_reports(text, path):
    """Reports from a table in which a curve takes a row a value, and tables may follow tables."""
    name, reports, header, key = name_of(path), [], None, None
    for at, row in enumerate(csv.reader(text.splitlines()), 1):
        if not row:
            continue
        if row[0] == "analyzer":
            header, key = row, None
            continue
        if header is None or header[:4] != ["analyzer", "source", "set", "count"]:
            raise input_error(f"{name}: is not a report; {WANTED}")
        if len(row) != len(header):
            raise input_error(f"{name}:{at}: has {len(row)} columns; expected {len(header)}")
        if not row[3].isdigit():
            raise input_error(f"{name}:{at}: '{row[3]}' is not a count")
        if row[:4] != key:
            key = row[:4]
            columns = {word: [] for word in header[6:]}
            chosen = int(row[2]) if row[2].isdigit() else None
            reports.append(Report(row[0], row[1], int(row[3]), 1, columns, {}, path, chosen))
        for word, cell in zip(header[6:], row[6:]):
            reports[-1].results[word].append(cell or None)
    return reports


def study_reports(text, path):
    """Reports from the table of a study: one for each measure of a set, with the generator as its source."""
    name, reports, dimensions = name_of(path), {}, set()
    for at, row in enumerate(csv.DictReader(text.splitlines()), 2):
        try:
            count, words = int(row["count"]), (row["generator"], row["dimension"], row["measure"], row["seed"])
            key, value = row["key"], row["value"]
        except (KeyError, TypeError, ValueError):
            raise input_error(f"{name}:{at}: is no row of a study") from None
        analyzer = words[2].partition(":")[0]
        report = Report(analyzer, words[0], count, 1, {}, {}, path, study=True)
        report = reports.setdefault((words, count), report)
        dimensions.add(words[1])
        if value:
            report.results[key] = value
    for (words, _), report in reports.items():
        if len(dimensions) > 1:
            report.source += f" in {words[1]}-D"
    return list(reports.values())


# ---------------------------------------------------------------- pictures


def plain(text):
    """Text that matplotlib draws as it stands, also with dollar signs and odd bytes."""
    text = str(text).encode("utf-8", "replace").decode()
    return "".join(c if c.isprintable() else " " for c in text).replace("$", r"\$")


def canvas():
    """matplotlib.pyplot, for files only and with the house style."""
    os.environ["MPLBACKEND"] = "Agg"
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcdefaults()  # the user's matplotlibrc must not change a figure
    plt.rcParams.update(
        {
            "font.family": "sans-serif",
            "font.size": 9,
            "axes.titlesize": 10,
            "axes.linewidth": 0.7,
            "axes.edgecolor": "#333333",
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
            "xtick.major.width": 0.7,
            "ytick.major.width": 0.7,
            "lines.linewidth": 1.2,
            "legend.frameon": False,
            "legend.fontsize": 8.5,
            "figure.dpi": 100,
            "svg.fonttype": "none",  # text stays text
            "svg.hashsalt": "stipple",  # the same bytes every time
            "pdf.fonttype": 42,
        }
    )
    return plt


def render(figure, kind, dpi=200):
    """The bytes of a figure; the same figure gives the same bytes."""
    metadata = {
        "png": {"Software": "stipple"},
        "svg": {"Date": None, "Creator": "stipple"},
        "pdf": {"CreationDate": None, "Creator": "stipple", "Producer": "matplotlib"},
    }
    shown = figure.get_default_bbox_extra_artists()  # the label of a third axis is not among them
    shown += [axes.zaxis.label for axes in figure.axes if hasattr(axes, "zaxis")]
    buffer = io.BytesIO()
    figure.savefig(
        buffer,
        format=kind,
        dpi=dpi,
        bbox_inches="tight",
        bbox_extra_artists=shown,
        pad_inches=0.06,
        metadata=metadata[kind],
    )
    return buffer.getvalue()


def write_bytes(path, data):
    """Writes beside the target and renames when whole; devices and '-' in place."""
    try:
        if path == "-":
            sys.stdout.buffer.write(data)
            sys.stdout.buffer.flush()
        elif os.path.exists(path) and not os.path.isfile(path):
            with open(path, "wb", buffering=0) as out:
                out.write(data)
        else:
            replace_file(path, data)
    except BrokenPipeError:  # nobody wants more; also not at the flush on exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        name = "standard output" if path == "-" else path
        raise file_error(f"{name}: {error.strerror or error}") from None


def replace_file(path, data):
    if os.path.exists(path) and not os.access(path, os.W_OK):
        raise OSError(0, "Permission denied")
    handle, beside = tempfile.mkstemp(dir=os.path.dirname(path) or ".", prefix=".stipple-")
    try:
        with os.fdopen(handle, "wb") as out:
            out.write(data)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(beside, 0o666 & ~mask)
        os.replace(beside, path)
    except BaseException:
        os.unlink(beside)
        raise


# ---------------------------------------------------------------- command line


class Parser(argparse.ArgumentParser):
    """Errors in one line; exit code 2 is argparse's own."""

    def __init__(self, description, examples, inputs="?", default="data/overview.png"):
        super().__init__(
            description=description,
            epilog="examples:\n" + examples,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        if inputs:
            default = "FILE's name with .png; for standard input there is none"
            self.add_argument(
                "input",
                metavar="FILE",
                nargs=inputs,
                default="-" if inputs == "?" else ["-"],
                help="'-' or nothing is standard input",
            )
            self.add_argument("--title", help="in place of the title from the data; '' for none")
        self.add_argument(
            "-o",
            "--output",
            metavar="PICTURE",
            help=f"a .png, .svg or .pdf file, or '-' (PNG) (default: {default})",
        )

    def error(self, message):
        message = message.replace("argument ", "", 1)
        raise usage_error(f"{message}; see {self.prog} --help")


def target_of(options, source):
    """Where the picture goes, and its format."""
    if options.output is None:
        if source is None or source == "-":
            raise usage_error("-o: is needed here; give a .png, .svg or .pdf file")
        return os.path.splitext(source)[0] + ".png", "png"
    if options.output == "-":
        return "-", "png"
    kind = EXTENSIONS.get(Path(options.output).suffix.lower())
    if kind is None:
        raise usage_error(f"-o: '{options.output}' does not end in .png, .svg or .pdf")
    return options.output, kind


def run(main):
    """Calls main() and exits as the program would."""
    name = Path(sys.argv[0]).name
    try:
        main()
    except Refusal as refusal:
        print(f"{name}: {refusal}", file=sys.stderr)
        sys.exit(refusal.code)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    except MemoryError:
        print(f"{name}: not enough memory", file=sys.stderr)
        sys.exit(LIMIT)

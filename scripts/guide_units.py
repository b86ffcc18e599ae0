# SPDX-License-Identifier: MIT
"""Pages of the guide's site for units: from their records, with a picture and commands of the guide that use them."""

import re
import subprocess
import tempfile
from pathlib import Path

from samples import SPECS, place_files

ROOT = Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^```(sh|console)\n(.*?)^```$", re.M | re.S)
# What stands before a unit's name in a command.
BEFORE = {
    "generators": r"(?:generate |--generators? |--of )['\"]?(?:[\w,;:=.-]*[,;])?",
    "scrambles": r"(?:warp |-w ['\"]?|--scramble |scramble=)",
    "warps": r"(?:warp |-w ['\"]?|--domain ['\"]?)",
    "analyzers": r"(?:analyze |--analyze )['\"]?(?:[^ ]*[,;])?",
}


def guide_commands():
    """All commands of the guide's pages: (page from docs, command)."""
    found = []
    for page in [*sorted((ROOT / "data/guide").glob("*.md")), ROOT / "data/lectures/README.md"]:
        for language, body in FENCE.findall(page.read_text(encoding="utf-8")):
            body = re.sub(r"(\\|\|)\n", r"\1 ", body)
            for line in body.splitlines():
                if line.startswith("$ stipple ") or (language == "sh" and line.startswith("stipple ")):
                    command = re.sub(r"\s*\\\s+", " ", line.removeprefix("$ "))
                    found.append((page.relative_to(ROOT / "data").as_posix(), re.sub(r"\s{2,}", " ", command).strip()))
    return found


def fallback(kind, name):
    """A command that uses a unit."""
    spec = SPECS.get(name, name)
    word = f"'{spec}'" if re.search(r"[\[*<>]", spec) else spec
    return {"generators": f"stipple generate {word.replace(':', ' --', 1).replace('=', ' ', 1)} -n 256 -o points.csv",
            "scrambles": f"stipple generate sobol -n 256 -w {word} -o points.csv",
            "warps": f"stipple generate sobol -n 256 -w {word} -o points.csv",
            "analyzers": f"stipple generate sobol -n 256 | stipple analyze {word}",
            "formats": f"stipple generate sobol -n 256 -f {word}"}[kind]


def examples(kind, unit, commands):
    """Up to three commands with a unit, the shortest ones, each with its page."""
    names = "|".join(re.escape(name) for name in [unit["name"], *unit["aliases"]])
    ending = rf"(?:{BEFORE.get(kind, '-f ')})(?:{names})(?![\w-])"
    found = {}
    for page, command in commands:
        if re.search(ending, command) and command not in found:
            found[command] = page
    best = sorted(found, key=len)[:3]
    text = "".join(f"{command}\n" for command in best) or fallback(kind, unit["name"]) + "\n"
    pages = sorted({found[command] for command in best})
    where = ", ".join(f"[{Path(page).stem if 'lectures' not in page else 'lectures'}](../../{page})" for page in pages)
    return f"## Examples\n\n```text\n{text}```\n" + (f"\nFrom {where}.\n" if where else "")


def written(value):
    """A default as one types it."""
    if isinstance(value, list):
        return (" " if value and isinstance(value[0], list) else ",").join(written(part) for part in value)
    return f"{value:g}" if isinstance(value, float) else str(value)


def option_line(option):
    """An item for an option: its values, default and help."""
    values = "|".join(option.get("choices", [])) or ("" if option["type"] == "flag" else option["type"].upper())
    notes = []
    if option.get("default") not in (None, False, "", []):
        notes.append(f"default `{written(option['default'])}`")
    if "range" in option:
        notes.append(f"in {option['range']}")
    if option.get("unit"):
        notes.append(option["unit"])
    return f"- `{('--' + option['name'] + ' ' + values).strip()}`{' (' + ', '.join(notes) + ')' if notes else ''}: {option['help']}\n"


def linked_source(source):
    source = re.sub(r"doi:((?:[^\s,;()]|\([^\s()]*\))+)", r"[doi:\1](https://doi.org/\1)", source)
    return re.sub(r"arXiv:(\d+\.\d+)", r"[arXiv:\1](https://arxiv.org/abs/\1)", source)


def anchor(heading):
    """The anchor of a heading: its letters and digits in lower case, with dashes for blanks."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", text.lower()).strip().replace(" ", "-")


def definition(unit, headings):
    """Link to the section of the definitions whose heading has the analyzer's name."""
    for heading in headings:
        if f"`{unit['name']}`" in heading:
            return f"## Definition\n\n[{heading.replace('`', '')}](../../guide/definitions.md#{anchor(heading)})\n\n"
    return ""


def draw(kind, unit, folder, target, stipple):
    """Draws points of a generator, or a warp's image of a grid; whether there is a picture."""
    spec = SPECS.get(unit["name"], unit["name"])
    size = ["--width", "420", "--height", "420", "--quiet", "-o", str(target)]
    tries = [["--generate", spec, "-n", "256"], ["--generate", spec]]
    if kind == "warps":
        tries = [["--generate", "jittered", "-n", count, "-d", d, "-w", spec]
                 for d, count in (("1", "400"), ("2", "400"), ("3", "343"))]
    for words in tries:
        try:
            stipple(["plot", *words, *size], folder)
        except subprocess.CalledProcessError:
            continue
        return True
    return False


def page(kind, unit, family, has_picture, commands, headings):
    """A unit's page."""
    text = f"# {unit['name']}\n\n{unit['summary']}.\n\n"
    if has_picture:
        what = "Points" if kind == "generators" else "Image of jittered points"
        text += f"![{what}, {unit['name']}]({unit['name']}.svg)\n\n"
    remarks = "; ".join(unit.get("remarks", []))
    text += f"{remarks[:1].upper()}{remarks[1:]}.\n\n" if remarks else ""
    text += f"Strata: {unit['strata']}.\n\n" if unit.get("strata") else ""
    if unit["aliases"]:
        text += "Also called " + ", ".join(f"`{name}`" for name in unit["aliases"]) + ".\n\n"
    text += f"Source: {linked_source(unit['source'])}.\n\n"
    if unit["options"]:
        text += "## Options\n\n" + "".join(option_line(option) for option in unit["options"]) + "\n"
    if unit.get("results"):
        text += "## Results\n\n"
        for result in unit["results"]:
            better = f" ({result['better']} is better)" if result.get("better") in ("lower", "higher") else ""
            text += f"- `{result['key']}`: {result['help']}{better}\n"
        text += "\n"
    text += definition(unit, headings) + examples(kind, unit, commands)
    if family:
        text += "\n## Related\n\n" + ", ".join(f"[{name}]({name}.md)" for name in family) + "\n"
    return text


def write_pages(docs, units, stipple):
    """Writes units/KIND/NAME.md, with a picture of each generator and warp."""
    commands = guide_commands()
    headings = [line[3:] for line in (ROOT / "data/guide/definitions.md").read_text(encoding="utf-8").splitlines()
                if line.startswith("## ")]
    with tempfile.TemporaryDirectory() as folder:
        place_files(folder)
        for kind, records in units.items():
            target = docs / "units" / kind
            target.mkdir(parents=True)
            for unit in records:
                drawn = kind in ("generators", "warps") and draw(kind, unit, folder, target / f"{unit['name']}.svg", stipple)
                family = [other["name"] for other in records
                          if other is not unit and other.get("family") == unit.get("family")]
                text = page(kind, unit, family, drawn, commands, headings)
                (target / f"{unit['name']}.md").write_text(text, encoding="utf-8")

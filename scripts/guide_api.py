# SPDX-License-Identifier: MIT
"""Pages of the guide's site for programs: the C++ and Python interfaces from their docstrings, and the Python tutorial."""

import ast
import contextlib
import importlib.util
import io
import os
import re
import sys
import tempfile
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


# C++: public headers are short enough to be read; each declaration stands below its comment.


def without_private(declaration):
    """A class without its private members."""
    lines, hidden = [], False
    for line in declaration.splitlines():
        if line.strip() in ("private:", "public:", "protected:"):
            hidden = line.strip() != "public:"
            if hidden:
                continue
        if line.startswith("}"):
            hidden = False
        if not hidden:
            lines.append(line)
    return re.sub(r"\n\n+(?=};?$)", "\n", "\n".join(lines))


def declarations(text):
    """Pairs of comment and declaration of a header, in its order."""
    body = text[text.index("namespace stipple {\n") + len("namespace stipple {\n"):]
    body = body[:body.rindex("}  // namespace stipple")]
    found, comment, lines = [], [], []

    def end():
        if lines:
            found.append((" ".join(comment), without_private("\n".join(lines).strip())))
        comment.clear()
        lines.clear()

    depth = 0
    for line in body.splitlines():
        if depth == 0 and line.startswith("///"):
            if lines:
                end()
            comment.append(line[3:].strip())
        elif depth == 0 and not line.strip():
            end()
        else:
            lines.append(line)
            depth += line.count("{") - line.count("}")
    end()
    return [(words, code) for words, code in found if not code.startswith("//")]


def plain_comment(words):
    """A comment with the marks of documentation as Markdown."""
    words = re.sub(r"\s*@throws ", "\n\nThrows ", words)
    words = re.sub(r"\s*@(?:param|tparam) (\S+)", r"\n\n`\1`:", words)
    return re.sub(r"(?<!`)\b(\w+(?:::\w+)*\(\))(?!`)", r"`\1`", words).replace("<", "&lt;")


def name_of(code):
    """Name of what a declaration declares."""
    found = re.search(r"(?:class|struct|enum class|using) (\w+)", code.splitlines()[0]) or re.search(r"(\w+)\(", code)
    return found[1] if found else code.split()[-1].rstrip(";")


def cpp_page():
    text = ("# C++ reference\n\nEvery name is in the namespace `stipple`; `#include <stipple/stipple.hpp>` has all of "
            "them, and the CMake target is `stipple::stipple`.\n")
    for header in sorted((ROOT / "src/stipple").glob("*.hpp")):
        source = header.read_text(encoding="utf-8")
        if "namespace stipple {" not in source:
            continue
        intro = re.search(r"^//\n((?://.*\n)+)#pragma once", source, re.M)
        text += f"\n## stipple/{header.name}\n\n"
        text += re.sub(r"^// ?", "", intro[1], flags=re.M).strip().replace("\nPromise", "\n\nPromise") + "\n" if intro else ""
        for words, code in declarations(source):
            text += f"\n### {name_of(code)}\n\n"
            text += plain_comment(words) + "\n\n" if words else ""
            text += f"```cpp\n{code}\n```\n"
    return text


# Python: docstrings of the public names.


def python_entry(node, level, prefix=""):
    """A function or class with its docstring, and the class's public methods."""
    words = ast.get_docstring(node) or ""
    if isinstance(node, ast.ClassDef):
        text = f"\n{'#' * level} class {prefix}{node.name}\n\n"
        fields = [ast.unparse(inner) for inner in node.body if isinstance(inner, ast.AnnAssign)]
        words += "\n\n" + "\n".join(fields) if fields else ""
        text += f"```text\n{words}\n```\n" if words else ""
        for inner in node.body:
            if isinstance(inner, ast.FunctionDef) and not inner.name.startswith("_") and ast.get_docstring(inner):
                text += python_entry(inner, level + 1, f"{node.name}.")
        return text
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    signature = textwrap.fill(f"{node.name}({ast.unparse(node.args)}){result}", 96, subsequent_indent="    ")
    return f"\n{'#' * level} {prefix}{node.name}\n\n```text\n{signature}\n\n{words}\n```\n"


def python_page():
    folder = ROOT / "src/python/stipple"
    package = ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))
    text = f"# Python reference\n\n```text\n{ast.get_docstring(package)}\n```\n\n## stipple\n"
    public = next(ast.literal_eval(node.value) for node in package.body
                  if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    known = {}
    for file in ("_arrays.py", "_errors.py", "_reports.py", "calls.py", "units.py"):
        for node in ast.parse((folder / file).read_text(encoding="utf-8")).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_"):
                known[node.name] = node
    text += "".join(python_entry(known[name], 3) for name in public if name in known)
    qmc = ast.parse((folder / "qmc.py").read_text(encoding="utf-8"))
    text += f"\n## stipple.qmc\n\n```text\n{ast.get_docstring(qmc)}\n```\n"
    for node in qmc.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_"):
            text += python_entry(node, 3)
    return text


def write_pages(docs):
    """Writes api/cpp.md and api/python.md; returns their places in the navigation."""
    (docs / "api").mkdir()
    (docs / "api/cpp.md").write_text(cpp_page(), encoding="utf-8")
    (docs / "api/python.md").write_text(python_page(), encoding="utf-8")
    return [{"C++": "api/cpp.md"}, {"Python": "api/python.md"}]


# The Python tutorial: cells with what they print and draw.


def run_cell(code, names):
    """Runs a cell as a notebook does: what it prints, and its last expression's value."""
    tree = ast.parse(code)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
    return printed.getvalue(), value


def cells_of(source):
    """Words and code of a script with cells, in turn."""
    return [cell.removeprefix(" [markdown]") for cell in source.split("# %%")[1:]]


def write_python_tutorial(docs):
    """Writes guide/tutorial-python.md: with outputs if the module can be imported, else without."""
    sys.path.insert(0, str(ROOT / "build/release/python"))
    runs = importlib.util.find_spec("stipple") is not None
    if not runs:
        print("scripts/guide: the Python module is not built: its tutorial has no outputs", file=sys.stderr)
    cells = cells_of((ROOT / "data/examples/tutorial.py").read_text(encoding="utf-8"))
    text, names, before = "", {"__name__": "__main__"}, os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for number, (words, code) in enumerate(zip(cells[::2], cells[1::2])):
            text += "\n" + re.sub(r"^# ?", "", words.strip(), flags=re.M) + f"\n\n```python\n{code.strip()}\n```\n"
            printed, value = run_cell(code, names) if runs else ("", None)
            text += f"\n```text\n{printed}```\n" if printed else ""
            if hasattr(value, "_repr_svg_"):
                name = f"tutorial-python-{number}.svg"
                (docs / "guide" / name).write_text(value._repr_svg_(), encoding="utf-8")
                text += f"\n![What the cell draws]({name})\n"
            elif value is not None:
                text += f"\n```text\n{value!r}\n```\n"
        os.chdir(before)
    (docs / "guide/tutorial-python.md").write_text(text, encoding="utf-8")
    index = docs / "guide/index.md"
    index.write_text(index.read_text(encoding="utf-8").replace("../examples/tutorial.py", "tutorial-python.md"),
                     encoding="utf-8")

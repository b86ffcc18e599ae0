# SPDX-License-Identifier: MIT
"""Builds the wheel of the package stipple for pip (PEP 517): calls CMake, needs no network. `pip install -C
cmake=-DSTIPPLE_FFT=pocketfft .` gives options to CMake. scripts/wheel uses it, too."""

import base64
import hashlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def version():
    return re.search(r"project\(stipple VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def build(options=(), targets=("stipple_package",)):
    """Builds targets of the preset `python`, by default the package alone; returns the build folder."""
    configure = ["cmake", "--preset", "python", f"-DPython3_EXECUTABLE={sys.executable}", *options]
    subprocess.run(configure, cwd=ROOT, check=True)
    _say("compiling the library takes about seven minutes of one processor; `pip install -v` shows each step")
    subprocess.run(["cmake", "--build", "--preset", "python", "-t", *targets], cwd=ROOT, check=True)
    return ROOT / "build" / "python"


def _say(line):
    """Prints a line on the terminal, if any: pip keeps standard output to itself."""
    try:
        with open("/dev/tty", "w", encoding="utf-8") as terminal:
            terminal.write(f"\n  stipple: {line}\n")
    except OSError:
        pass


def _metadata():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    citation = (ROOT / "CITATION.cff").read_text()
    author = re.search(r"- name: (.*)", citation)[1]
    keywords = ",".join(re.findall(r"- (.*)", citation.partition("keywords:")[2]))
    about = " ".join(re.search(r"abstract: >-((?:\n  .*)+)", citation)[1].split())
    return (f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {version()}\n"
            f"Summary: {project['description']}\nLicense: {project['license']['text']}\n"
            f"Author: {author}\nKeywords: {keywords}\nRequires-Python: {project['requires-python']}\n"
            + "".join(f"Requires-Dist: {needed}\n" for needed in project["dependencies"])
            + f"Description-Content-Type: text/plain\n\n{about}\n")


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    info = Path(metadata_directory) / f"stipple-{version()}.dist-info"
    info.mkdir(parents=True, exist_ok=True)
    (info / "METADATA").write_text(_metadata())
    return info.name


def package_files(folder):
    """Files of the package in a build folder, with the licences of all that is compiled in: their names in the wheel,
    and contents."""
    files = {f"stipple/{path.name}": path.read_bytes()
             for path in sorted((folder / "python" / "stipple").iterdir()) if path.is_file()}
    return files | {f"stipple-{version()}.dist-info/licenses/copyright": (folder / "copyright").read_bytes()}


def write_wheel(folder, platform, files):
    """Writes a wheel of files, to which metadata and LICENSE are added; returns its name."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{platform}"
    info = f"stipple-{version()}.dist-info"
    files = files | {
        f"{info}/licenses/LICENSE": (ROOT / "LICENSE").read_bytes(),
        f"{info}/METADATA": _metadata().encode(),
        f"{info}/WHEEL": ("Wheel-Version: 1.0\nGenerator: stipple_build\n"
                          f"Root-Is-Purelib: false\nTag: {tag}\n").encode()}
    record = ""
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"stipple-{version()}-{tag}.whl"
    with zipfile.ZipFile(Path(folder) / wheel, "w") as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name)  # without the time: the same files make the same wheel
            entry.external_attr = (0o100755 if content.startswith(b"\x7fELF") else 0o100644) << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED, 9)
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    options = (config_settings or {}).get("cmake", [])
    folder = build([options] if isinstance(options, str) else options)
    platform = re.sub("[-.]", "_", sysconfig.get_platform())
    return write_wheel(wheel_directory, platform, package_files(folder))


def build_sdist(sdist_directory, config_settings=None):
    name = f"stipple-{version()}"
    with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as archive:
        for path in sorted(ROOT.iterdir()):
            if path.name not in ("build", ".git"):
                archive.add(path, f"{name}/{path.name}")
    return f"{name}.tar.gz"

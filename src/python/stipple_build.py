# SPDX-License-Identifier: MIT
"""Builds the wheel of the package stipple for pip (PEP 517): calls CMake, needs no network."""

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


def _version():
    return re.search(r"project\(stipple VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def _package():
    """Builds the package; returns its folder."""
    configure = ["cmake", "--preset", "python", f"-DPython3_EXECUTABLE={sys.executable}"]
    subprocess.run(configure, cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", "--preset", "python"], cwd=ROOT, check=True)
    return ROOT / "build" / "python" / "python" / "stipple"


def _metadata():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    return (f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {_version()}\n"
            f"Summary: {project['description']}\nLicense: {project['license']['text']}\n"
            f"Requires-Python: {project['requires-python']}\n"
            + "".join(f"Requires-Dist: {needed}\n" for needed in project["dependencies"]))


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    info = Path(metadata_directory) / f"stipple-{_version()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(_metadata())
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = _package()
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"stipple-{_version()}.dist-info"
    files = {f"stipple/{path.name}": path.read_bytes()
             for path in sorted(package.iterdir()) if path.is_file()}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: stipple_build\n"
                              f"Root-Is-Purelib: false\nTag: {tag}\n").encode()
    record = ""
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"stipple-{_version()}-{tag}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    name = f"stipple-{_version()}"
    with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as archive:
        for path in sorted(ROOT.iterdir()):
            if path.name not in ("build", ".git"):
                archive.add(path, f"{name}/{path.name}")
    return f"{name}.tar.gz"

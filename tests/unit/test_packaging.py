# SPDX-License-Identifier: GPL-3.0-or-later
"""The manifest agrees with the code, the build and the changelog."""

import ast
import re
import subprocess
import sys
import tomllib
import zipfile
from importlib import metadata
from pathlib import Path

import pytest

from core import VERSION

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def manifest():
    return tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))


def wheel_fields(wheel):
    """Name, version, Python, ABI and platforms of a wheel."""
    return Path(wheel).name.removesuffix(".whl").split("-")


def test_version_is_the_one_of_the_code_and_has_an_entry_in_the_changelog(manifest):
    assert manifest["version"] == VERSION
    entries = re.findall(r"^## (\S+)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert entries[0] == VERSION


def test_the_build_knows_the_digest_of_every_wheel_and_of_no_other(manifest):
    lines = (ROOT / "tools" / "wheels.sha256").read_text(encoding="ascii").splitlines()
    wheels = [*(Path(wheel).name for wheel in manifest["wheels"]), build_constant("DEBIAN_WHEEL")]
    assert sorted(line.split()[1] for line in lines) == sorted(wheels)


def test_the_zip_for_debian_differs_by_its_wheel_alone(manifest):
    """Nobody else downloads the wheel of Debian's Python, and Debian's build none of the others."""
    code = "import pathlib, sys; sys.path.insert(0, 'tools'); import build; " \
           "sys.stdout.write(build.debian_manifest(pathlib.Path('blender_manifest.toml').read_text(encoding='utf-8')))"
    text = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, check=True).stdout
    debian = tomllib.loads(text.decode())
    assert debian.pop("wheels") == [f"./wheels/{build_constant('DEBIAN_WHEEL')}"]
    assert debian.pop("platforms") == ["linux-x64"]
    assert debian == {key: value for key, value in manifest.items() if key not in ("wheels", "platforms")}
    assert wheel_fields(build_constant("DEBIAN_WHEEL"))[:3] == ["scipy", "1.18.1", "cp314"]


def test_the_manifest_says_what_the_site_asks_for(manifest):
    assert set(manifest["permissions"]) == {"files"}  # neither network nor clipboard, camera, microphone
    for reason in (manifest["tagline"], *manifest["permissions"].values()):
        assert len(reason) <= 64
        assert reason[-1].isalnum()
    assert "Blender" not in manifest["name"]
    assert manifest["website"].startswith("https://")
    assert all(re.fullmatch(r"\d{4}(-\d{4})? \S.*\S", line) for line in manifest["copyright"])


def test_whom_the_wheels_name_is_credited(manifest):
    """Every holder in the licence files of SciPy as it is installed here, and of the wheels that are at hand."""
    credited = " ".join(manifest["copyright"])
    licences = {"installed": "\n".join(
        file.locate().read_text(encoding="utf-8", errors="replace") for file in metadata.files("scipy")
        if LICENCE.search(file.name) and ".dist-info" in str(file))}
    assert "SciPy Developers" in licences["installed"]
    for wheel in [ROOT / wheel for wheel in manifest["wheels"] if (ROOT / wheel).exists()]:
        with zipfile.ZipFile(wheel) as archive:
            licences[wheel.name] = "\n".join(archive.read(name).decode("utf-8", "replace")
                                             for name in archive.namelist() if LICENCE.search(name))
    for where, text in licences.items():
        for holder in HOLDERS:
            if holder in text:
                assert holder in credited, (where, holder)
        found = set(re.findall(r"(?im)^\W*copyright \(c\)\s+[\d, -]+,?\s*(.+?)[\s.,<]*$", text))
        assert {line for line in found if not any(holder in line for holder in HOLDERS)} <= NO_HOLDERS


LICENCE = re.compile(r"LICEN[CS]E|COPYING")
#: Names in the licence files of the wheels that hold copyright in what the wheels carry.
HOLDERS = (
    "Enthought", "SciPy Developers", "The OpenBLAS Project", "The University of Tennessee", "Free Software Foundation",
    "The University of California Berkeley", "The University of Colorado Denver", "Quansight-Labs", "Rice University",
    "Max-Planck-Society", "Scilab Enterprises", "C.B. Barber",
)
#: Lines that look as if they named one: patches to the way in which ARPACK is built elsewhere.
NO_HOLDERS = {"Jordi Gutiérrez Hermoso (Octave patch)", "Sébastien Fabbro (gentoo patch)"}


def build_constant(name):
    """A constant of tools/build.py."""
    builder = ast.parse((ROOT / "tools" / "build.py").read_text(encoding="utf-8"))
    (value,) = (node.value for node in builder.body if isinstance(node, ast.Assign) and node.targets[0].id == name)
    return ast.literal_eval(value)


def test_scipy_alone_is_bundled(manifest):
    # A wheel of NumPy would replace the one that Blender and every other extension use.
    assert {wheel_fields(wheel)[0] for wheel in manifest["wheels"]} == {"scipy"}


@pytest.mark.parametrize("python", ["cp311", "cp313"])
def test_every_platform_has_one_wheel_for_every_official_blender(manifest, python):
    platforms = [wheel_fields(wheel)[4] for wheel in manifest["wheels"] if wheel_fields(wheel)[2] == python]
    assert sorted(platforms) == [
        "macosx_10_13_x86_64", "macosx_12_0_arm64", "manylinux_2_17_x86_64.manylinux2014_x86_64", "win_amd64",
    ]
    assert len(platforms) == len(manifest["platforms"])


def test_everything_in_the_checkout_is_shipped_or_left_out_on_purpose(manifest):
    builder = ast.parse((ROOT / "tools" / "build.py").read_text(encoding="utf-8"))
    (shipped,) = (node.value for node in builder.body
                  if isinstance(node, ast.Assign) and node.targets[0].id == "SHIPPED")
    known = {item.value for item in shipped.elts if isinstance(item, ast.Constant)} | {"blender_manifest.toml"}
    known |= {pattern.strip("/") for pattern in manifest["build"]["paths_exclude_pattern"]}
    assert {path.name for path in ROOT.iterdir() if not path.name.startswith(".")} - known == set()


def test_official_blenders_share_one_scipy(manifest):
    # The one release that works with the NumPy of Blender 4.2 (1.24) and of 5.2 (2.3).
    assert {wheel_fields(wheel)[1] for wheel in manifest["wheels"]} == {"1.15.3"}
    assert {wheel_fields(wheel)[2] for wheel in manifest["wheels"]} == {"cp311", "cp313"}


def test_the_panel_comes_up_without_scipy():
    """Another extension may have replaced SciPy by one that does not load; the panel has to say so.

    What the modules of Blender's side import from core at their top has to do without it.
    """
    names = set()
    for folder in ("scene", "viewport", "operators", "ui", "batch"):
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.parse(path.read_text(encoding="utf-8")).body:
                if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("core."):
                    names.add(node.module)
    names.discard("core.uses.report")  # of scene/saving/object_report.py, which the command imports once SciPy is there
    assert "core.result.numbering" in names
    code = "import sys; sys.modules['scipy'] = None\n" + "\n".join(f"import {name}" for name in sorted(names))
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_no_shipped_module_starts_threads(manifest):
    """Blender's Python does not support them, and the moderators of its extensions site refuse them."""
    refused = {"threading", "_thread", "multiprocessing", "concurrent", "asyncio"}
    builder = (ROOT / "tools" / "build.py").read_text(encoding="utf-8")
    folders = [name for name in ("batch", "core", "operators", "scene", "ui", "viewport") if f'"{name}"' in builder]
    left_out = {ROOT / pattern.strip("/") for pattern in manifest["build"]["paths_exclude_pattern"]}
    assert ROOT / "core" / "second_thread.py" in left_out
    paths = [ROOT / "__init__.py", *(path for name in folders for path in (ROOT / name).rglob("*.py"))]
    paths = [path for path in paths if path not in left_out]
    assert len(folders) == 6
    found = set()
    for path in paths:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) and not node.level else []
            found |= {(path.relative_to(ROOT).as_posix(), name) for name in names if name.split(".")[0] in refused}
    assert found == set()

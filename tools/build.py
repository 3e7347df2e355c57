# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the extension: one zip per platform in dist/, each with the SciPy wheels of that platform, and one for Debian.

    python3 tools/build.py [--blender PATH] [--out DIR]

The wheels named in blender_manifest.toml are downloaded into wheels/ once and compared with
tools/wheels.sha256. The zip called "debian" is for the Blender that Debian builds for its own Python; it is not for
the extensions site. Blender's own extension tool validates and packs, from the given Blender or from
Blender as a Python module in .venv/. The same checkout gives the same bytes, whenever and wherever.
"""

from __future__ import annotations

import argparse
import hashlib
import re
import shutil
import subprocess
import tempfile
import tomllib
import zipfile
from pathlib import Path

import environments
from environments import ROOT, fail, say

MANIFEST = "blender_manifest.toml"
SHIPPED = {"__init__.py", MANIFEST, "LICENSE", "batch", "core", "operators", "scene", "ui", "viewport", "wheels"}
# What Debian's build needs in place of the other wheels: it has another Python and a newer NumPy.
DEBIAN_WHEEL = "scipy-1.18.1-cp314-cp314-manylinux_2_27_x86_64.manylinux_2_28_x86_64.whl"
# The oldest date a zip can hold; what is in the files is what matters.
ZIP_DATE = (1980, 1, 1, 0, 0, 0)


def main() -> None:
    """Download, check, validate, build, repack."""
    manifest = tomllib.loads((ROOT / MANIFEST).read_text(encoding="utf-8"))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", metavar="PATH", help="use this Blender's extension tool")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", metavar="DIR", help="default: dist/")
    arguments = parser.parse_args()

    tool = [arguments.blender, "--command", "extension"] if arguments.blender else _tool_of_module()
    for wheel in (*manifest["wheels"], DEBIAN_WHEEL):
        _download(Path(wheel).name)
    arguments.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as built:
        _check([*tool, "validate", str(ROOT)])
        _check([*tool, "build", "--split-platforms", "--source-dir", str(ROOT), "--output-dir", built])
        _build_for_debian(tool, Path(built) / f"{manifest['id']}-{manifest['version']}-debian_x64.zip")
        for package in sorted(Path(built).glob("*.zip")):
            _check([*tool, "validate", str(package)])
            target = arguments.out / package.name
            _repack(package, target)
            digest = hashlib.sha256(target.read_bytes()).hexdigest()
            say(f"{target} ({target.stat().st_size / 1e6:.1f} MB, sha256 {digest})")


def _build_for_debian(tool: list[str], package: Path) -> None:
    """Build the same files with another wheel; package : the zip to make."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder)
        for name in SHIPPED - {MANIFEST, "wheels"}:
            copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copyfile
            copy(ROOT / name, source / name)
        (source / "wheels").mkdir()
        shutil.copyfile(ROOT / "wheels" / DEBIAN_WHEEL, source / "wheels" / DEBIAN_WHEEL)
        (source / MANIFEST).write_text(debian_manifest((ROOT / MANIFEST).read_text(encoding="utf-8")), encoding="utf-8")
        _check([*tool, "build", "--source-dir", folder, "--output-filepath", str(package)])


def debian_manifest(text: str) -> str:
    """The manifest for Debian's build, from that for the others."""
    for key, value in (("platforms", "linux-x64"), ("wheels", f"./wheels/{DEBIAN_WHEEL}")):
        text, count = re.subn(rf"(?ms)^{key} = \[.*?\]$", f'{key} = ["{value}"]', text)
        if count != 1:
            fail(f"{MANIFEST} has no list of {key}")
    return text


def _tool_of_module() -> list[str]:
    """The extension tool out of the bpy wheel: it needs no Blender executable."""
    python = environments.prepare(environments.any_blender())
    return [str(python), str(next((python.parent.parent / "lib").rglob("bl_pkg/cli/blender_ext.py")))]


def _download(wheel: str) -> None:
    """Fetch a wheel unless it is in wheels/ already, and compare it with its known digest."""
    path = ROOT / "wheels" / wheel
    path.parent.mkdir(exist_ok=True)
    if not path.exists():
        say(f"downloading {wheel}")
        name, version, interpreter, abi, platforms = wheel.removesuffix(".whl").split("-")
        python = environments.prepare(environments.any_python("build"))
        target = ["--implementation", "cp", "--python-version", interpreter.removeprefix("cp"), "--abi", abi]
        for platform in platforms.split("."):
            target += ["--platform", platform]
        pip = [str(python), "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:"]
        _check([*pip, *target, "--dest", str(path.parent), f"{name}=={version}"])
    lines = (ROOT / "tools" / "wheels.sha256").read_text(encoding="ascii").splitlines()
    digests = {name: digest for digest, name in (line.split() for line in lines)}
    if hashlib.sha256(path.read_bytes()).hexdigest() != digests[wheel]:
        fail(f"wheels/{wheel} is not the known file: delete it and try again.")


def _repack(package: Path, target: Path) -> None:
    """Write the zip again with sorted names and one date, and nothing in it that should not be there."""
    partial = target.with_suffix(".partial")
    with zipfile.ZipFile(package) as old, zipfile.ZipFile(partial, "w") as new:
        names = sorted(old.namelist())
        if strangers := {name for name in names if name.split("/")[0] not in SHIPPED}:
            fail(f"not meant to be shipped: {', '.join(sorted(strangers))}; see [build] in {MANIFEST}")
        for name in names:
            entry = zipfile.ZipInfo(name, ZIP_DATE)
            entry.external_attr = 0o644 << 16
            entry.create_system = 3
            # A wheel is a zip itself.
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(".whl") else zipfile.ZIP_DEFLATED
            new.writestr(entry, old.read(name), compresslevel=9)
    partial.replace(target)


def _check(command: list[str]) -> None:
    """Run a step and stop when it fails."""
    result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if result.returncode:
        fail(f"{' '.join(command)}\n{result.stdout}{result.stderr}".rstrip())


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension switched on, an empty scene for each test, and what the tests compare scenes by.

In Blender as a module the checkout is the package; in a full Blender the installed zip is.
"""

import sys
from pathlib import Path

import bpy
import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def package(tmp_path_factory):
    """The name under which the extension is enabled."""
    for name in sys.modules:
        if name.startswith("bl_ext.") and name.endswith(".reeb_parts"):
            return name
    import addon_utils

    folder = tmp_path_factory.mktemp("extensions")
    (folder / "reeb_parts").symlink_to(ROOT)
    bpy.context.preferences.extensions.repos.new(
        name="development", module="development", custom_directory=str(folder)
    )
    name = "bl_ext.development.reeb_parts"
    assert addon_utils.enable(name, default_set=True) is not None
    return name


@pytest.fixture(autouse=True)
def scene(package):
    """An empty scene, with the extension enabled."""
    bpy.ops.wm.read_homefile(use_empty=True)
    return bpy.context.scene

# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension switched on, an empty scene for each test, and a mesh with obvious parts.

In Blender as a module the checkout is the package; in a full Blender the installed zip is.
"""

import importlib
import os
import sys
from pathlib import Path

import bpy
import checkout
import numpy as np
import pytest
import shapes
from diagonal import in_sixths
from snapshot import activate


def pytest_collection_modifyitems(config, items):
    """Leave out what of this folder is not in the sixths that are asked for."""
    out = [item for item in items if Path(__file__).parent in item.path.parents and not in_sixths(item.nodeid)]
    items[:] = [item for item in items if item not in out]
    config.hook.pytest_deselected(items=out)


@pytest.fixture(scope="session")
def package(tmp_path_factory):
    """The name under which the extension is enabled."""
    name = checkout.enable(tmp_path_factory.mktemp("extensions"))
    # Of the few meshes that tests decompose over and over, by four methods, Blender keeps three results.
    importlib.import_module(f"{name}.scene.runs.compute")._KEEP = 100
    return name


@pytest.fixture(autouse=True)
def scene(package):
    """An empty scene, with the extension enabled."""
    bpy.ops.wm.read_homefile(use_empty=True)
    return bpy.context.scene


@pytest.fixture(scope="session")
def tree():
    """Vertices and triangles of a trunk with four branches."""
    return shapes.tube_tree()


@pytest.fixture
def make(scene):
    """A function that adds an object with a mesh, active and selected alone."""

    def make_object(shape, name="Tree"):
        vertices, faces = shape
        mesh = bpy.data.meshes.new(name)
        as_lists = faces.tolist() if isinstance(faces, np.ndarray) else [list(map(int, face)) for face in faces]
        mesh.from_pydata(np.asarray(vertices).tolist(), [], as_lists)
        obj = bpy.data.objects.new(name, mesh)
        bpy.context.scene.collection.objects.link(obj)
        activate(obj)
        return obj

    return make_object


@pytest.fixture
def obj(make, tree):
    """The tree as an object."""
    return make(tree)


@pytest.fixture
def parameters_of_result():
    """Those that are not left at their defaults; a module may have others."""
    return {}


@pytest.fixture
def result(obj, parameters_of_result):
    """What is stored with the tree once it is decomposed."""
    bpy.ops.reeb_parts.decompose(**parameters_of_result)
    return obj.data.reeb_parts


@pytest.fixture
def settings(obj):
    """The settings of the scene once the tree is decomposed by the method of few parts."""
    bpy.ops.reeb_parts.decompose(method="berretti")
    return bpy.context.scene.reeb_parts


@pytest.fixture
def scene_module(package):
    """A function that gives a module of the extension's scene by its name."""
    return lambda name: importlib.import_module(f"{package}.scene.{name}")


@pytest.fixture
def parameters(package):
    """The class of the parameters."""
    return importlib.import_module(f"{package}.core.parameters").Parameters


_status = 0


def pytest_sessionfinish(session, exitstatus):
    global _status
    _status = int(exitstatus)


@pytest.hookimpl(trylast=True)
def pytest_unconfigure(config):
    """End at once in Blender as a module, which may hang when it frees what a failed test still holds."""
    if not bpy.app.binary_path:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(_status)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes are looked at once they have been left alone for a moment: whether they were edited, or others joined in."""

import importlib

import pytest


@pytest.fixture
def look(package, monkeypatch):
    """What a timer calls in a window; the module."""
    watch = importlib.import_module(f"{package}.scene.changes.watch")
    monkeypatch.setattr(watch, "REST", 0.0)
    return watch


@pytest.mark.parametrize("edited", [False, True])
def test_a_file_that_was_edited_without_us_says_so_once_it_is_opened(look, obj, result, edited):
    """It did only after the first command."""
    look._waiting.clear()
    obj.data.vertices[0].co.x += edited  # nobody is told
    look._opened()
    assert look.bpy.app.timers.is_registered(look._look)
    look._look()
    assert obj.data.reeb_parts.edited == edited

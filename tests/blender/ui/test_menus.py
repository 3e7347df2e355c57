# SPDX-License-Identifier: GPL-3.0-or-later
"""The menus, and whether the panel says that parameters differ from their preset."""

import re
import sys
from pathlib import Path

import bpy
import pytest
from snapshot import activate


def test_parameters_are_set_back_to_the_preset(settings):
    assert not settings.differs_from_preset()
    settings.detail = 0.8
    assert not settings.differs_from_preset()
    settings.small_region = 0.01
    settings.equalize = False
    assert settings.differs_from_preset()
    bpy.ops.reeb_parts.reset_parameters()
    assert not settings.differs_from_preset()
    assert settings.detail == pytest.approx(0.8)
    settings.preset = "Berretti 2009"
    assert not settings.differs_from_preset()
    settings.method = "perceptual"
    assert settings.differs_from_preset()


def test_every_operator_is_in_a_menu(package, settings):
    """Blender's search looks through menus; what is in none of them is not found."""
    operators = sys.modules[f"{package}.operators"]
    menus = Path(sys.modules[f"{package}.ui.menus"].__file__).read_text(encoding="utf-8")
    found = set(re.findall(r'"(reeb_parts\.\w+)"', menus))
    wanted = {cls.bl_idname for cls in operators.CLASSES if issubclass(cls, bpy.types.Operator)
              and "INTERNAL" not in cls.bl_options}
    assert wanted - found == set()


def test_the_menu_is_there_in_every_mode_that_operators_work_in(obj, settings, package):
    menus = sys.modules[f"{package}.ui.menus"]
    activate(obj)
    for mode, menu in (("OBJECT", "object"), ("EDIT", "edit_mesh"), ("SCULPT", "sculpt"),
                       ("WEIGHT_PAINT", "paint_weight"), ("VERTEX_PAINT", "paint_vertex")):
        bpy.ops.object.mode_set(mode=mode)
        drawn = getattr(bpy.types, f"VIEW3D_MT_{menu}").draw._draw_funcs
        assert menus._draw in drawn
    bpy.ops.object.mode_set(mode="OBJECT")

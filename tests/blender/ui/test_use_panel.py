# SPDX-License-Identifier: GPL-3.0-or-later
"""Which settings of Separate are shown, in its panel and after it."""

import importlib

import bpy
import pytest


def names():
    return [prop.identifier for prop in bpy.context.scene.reeb_parts_use.bl_rna.properties
            if prop.identifier not in {"rna_type", "name"}]


def test_settings_that_do_not_count_are_not_shown():
    use = bpy.context.scene.reeb_parts_use
    assert not {name for name in use.rows if name.startswith("joint_")} | ({"cap_material", "bed"} & set(use.rows))
    use.caps = True
    assert use.rows.index("cap_material") == use.rows.index("caps") + 1
    use.caps, use.fit_bed = False, True
    assert use.rows.index("bed") == use.rows.index("fit_bed") + 1
    assert "cap_material" in use.rows  # the bed's cuts are closed


def test_all_settings_are_shown_where_all_count():
    use = bpy.context.scene.reeb_parts_use
    use.caps, use.fit_bed, use.joints = True, True, "ROUND"
    assert sorted(use.rows) == sorted(names())
    assert use.rows[:2] == ["which", "cut"]


@pytest.mark.parametrize(("system", "scale", "words"), [
    ("METRIC", 1.0, "8.363 mm"), ("METRIC", 0.001, "8.363 µm"), ("IMPERIAL", 1.0, "329.3 thou"),
    ("NONE", 1.0, "0.008363"),
])
def test_how_thick_a_piece_is_stands_in_the_units_of_the_scene(package, system, scale, words):
    """A bare 0.008363 stood beside joints in millimeters, in a scene in inches."""
    units = bpy.context.scene.unit_settings
    units.system, units.scale_length = system, scale
    assert importlib.import_module(f"{package}.ui.use_panel").length_words(0.008363) == words

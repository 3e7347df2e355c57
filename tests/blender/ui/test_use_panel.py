# SPDX-License-Identifier: GPL-3.0-or-later
"""Which settings of Separate are shown, in its panel and after it."""

import bpy


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

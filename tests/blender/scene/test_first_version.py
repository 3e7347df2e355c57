# SPDX-License-Identifier: GPL-3.0-or-later
"""Files and scripts of version 0.1.0: what they hold and ask for is understood."""

import json
from pathlib import Path

import bpy
import pytest
from results import numbers

DATA = Path(__file__).resolve().parents[2] / "data"


@pytest.fixture
def seen():
    """What was to be seen in the file when version 0.1.0 saved it, the file open."""
    bpy.ops.wm.open_mainfile(filepath=str(DATA / "saved_by_0_1_0.blend"))
    return json.loads((DATA / "saved_by_0_1_0.json").read_text(encoding="utf-8"))


def listed(result):
    return [{"number": part.number, "name": part.name, "color": [round(c, 6) for c in part.color],
             "share": part.share, "locked": part.locked, "pinned": part.pinned, "group": part.group}
            for part in result.parts]


def test_a_file_opens_with_its_parts_pins_names_and_colors(seen):
    mesh = bpy.data.objects["Tree"].data
    assert listed(mesh.reeb_parts) == seen["parts"]
    assert numbers(mesh).tolist() == seen["labels"]
    nodes = [item for item in bpy.data.objects if item.get("reeb_parts_role") == "node"]
    assert [[*(round(x, 5) for x in item.location), item["part"]] for item in nodes] == seen["nodes"]


def test_its_levels_of_detail_are_those_of_then(seen):
    result = bpy.data.objects["Tree"].data.reeb_parts
    for detail, expected in seen["levels"].items():
        result.detail = float(detail)
        assert [part.number for part in result.parts] == expected
    assert listed(result) == seen["parts"]
    assert numbers(result.id_data).tolist() == seen["labels"]


def test_it_can_be_worked_on_and_decomposed_again(seen):
    obj = bpy.data.objects["Tree"]
    result = obj.data.reeb_parts
    named = {part["number"]: part["name"] for part in seen["parts"] if part["name"] != f"Part {part['number']:02d}"}
    assert named
    bpy.ops.reeb_parts.decompose(**{name: getattr(bpy.context.scene.reeb_parts, name)
                                    for name in ("n_slabs", "concavity_weight", "band_ratio", "equalize")}, detail=0.6)
    again = {part.number: part for part in result.parts}
    assert {number: again[number].name for number in named} == named
    assert [number for number, part in again.items() if part.locked] == [
        part["number"] for part in seen["parts"] if part["locked"]]
    bpy.ops.reeb_parts.clear()
    assert not obj.data.reeb_parts.data  # what was clear has taken away cannot be asked any more


def test_parameters_of_its_scene_have_the_names_of_today(seen):
    settings = bpy.context.scene.reeb_parts
    assert settings.n_slabs == 80
    assert not settings.is_property_set("levels")


def test_a_script_sets_the_scene_by_the_names_of_then(obj):
    settings = bpy.context.scene.reeb_parts
    settings.levels, settings.alpha, settings.equalise = 50, 0.25, False
    assert (settings.n_slabs, settings.concavity_weight, settings.band_ratio, settings.equalize) == (
        50, 0.25, 0.25, False)
    settings.levels = 60  # a second time, too
    assert settings.n_slabs == 60


def test_a_script_calls_the_operator_by_the_names_of_then(obj, capfd):
    bpy.ops.reeb_parts.decompose(method="berretti", n_slabs=40, concavity_weight=0.25, band_ratio=0.25)
    expected = numbers(obj.data).tolist()
    bpy.ops.reeb_parts.clear()
    bpy.ops.reeb_parts.decompose(method="berretti", levels=40, alpha=0.25)
    assert numbers(obj.data).tolist() == expected
    said = capfd.readouterr().out
    assert "The parameter levels is called n_slabs now." in said
    assert "The parameter alpha is called concavity_weight, band_ratio now." in said

# SPDX-License-Identifier: GPL-3.0-or-later
"""Under Advanced, each method has the settings that it heeds, and no others."""

from dataclasses import fields
from importlib import import_module

import pytest

#: Settings of cuts that each method heeds besides the smoothing, as tests/unit/test_pipeline.py tries.
OWN = {"perceptual": {"band_ratio", "follow_level_sets"},
       "berretti": {"small_region", "sigma", "concavity_weight", "band_ratio", "follow_level_sets"},
       "lavoue": {"n_clusters"}, "liu": {"outline_weight"}}


@pytest.fixture
def shown(package):
    """A function that gives the names of the settings of cuts that are shown with a method."""
    panel = import_module(f"{package}.ui.advanced_panel")
    always = {"method", "hints", "pieces", "symmetry", "loose_part", "smoothing"}
    panels = panel.REEB_PARTS_PT_graph, panel.REEB_PARTS_PT_boundaries
    return lambda method: {name for panel in panels for name in panel.counting(method)} - always


@pytest.mark.parametrize("method", OWN)
def test_settings_that_the_method_does_not_heed_are_not_shown(shown, method):
    assert shown(method) == OWN[method]


def test_what_one_method_alone_heeds_says_so(package, shown):
    """In its tooltip and in the help of the command, which lists the parameters of all methods."""
    parameters = import_module(f"{package}.core.parameters")
    for field in fields(parameters.Parameters):
        methods = [method for method in OWN if field.name in shown(method)]
        named = [parameters.PRESETS[name].method for name in parameters.PRESETS
                 if field.metadata["description"].startswith(f"{name}: ")]
        assert named == (methods if len(methods) == 1 else [])

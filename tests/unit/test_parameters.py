# SPDX-License-Identifier: GPL-3.0-or-later
"""Ranges, messages and presets of the parameters."""

from dataclasses import FrozenInstanceError, fields
from decimal import Decimal
from fractions import Fraction
from typing import get_type_hints

import numpy as np
import pytest

from core.errors import ParameterError
from core.parameters import METHODS, PRESETS, Parameters

NUMBERS = sorted(Parameters.RANGES)
WHOLE = sorted(f.name for f in fields(Parameters) if f.name in NUMBERS and f.type == "int")


@pytest.mark.parametrize("name", NUMBERS)
def test_both_ends_of_every_range_are_allowed(name):
    for value in Parameters.RANGES[name]:
        assert getattr(Parameters(**{name: value}), name) == value


@pytest.mark.parametrize("name", NUMBERS)
def test_outside_every_range_the_message_names_parameter_range_and_value(name):
    low, high = Parameters.RANGES[name]
    for value in (low - 1, high + 1, float("nan"), float("inf")):
        with pytest.raises(ParameterError) as caught:
            Parameters(**{name: value})
        assert caught.value.name == name
        message = str(caught.value)
        assert message.startswith(f"{name} must be a ")
        assert f"from {low} to {high}" in message
        assert repr(value) in message


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("value", ["many", None, [1]])
def test_what_is_no_number_is_refused(name, value):
    with pytest.raises(ParameterError, match=f"^{name} must be a number, not ") as caught:
        Parameters(**{name: value})
    assert caught.value.name == name


@pytest.mark.parametrize("name", WHOLE)
def test_counts_are_whole(name):
    low, _ = Parameters.RANGES[name]
    with pytest.raises(ParameterError, match="whole number"):
        Parameters(**{name: low + 0.5})


def test_unknown_method():
    with pytest.raises(ParameterError, match="method must be one of") as caught:
        Parameters(method="magic")
    assert caught.value.name == "method"
    assert all(method in str(caught.value) for method in METHODS)


def test_ranges_contain_the_defaults_and_every_field_explains_itself():
    for item in fields(Parameters):
        assert item.metadata["description"]
        assert item.metadata["label"]
        if item.name in Parameters.RANGES:
            low, high = Parameters.RANGES[item.name]
            assert low <= item.default <= high
            assert low < high
            assert get_type_hints(Parameters)[item.name] is (int if item.metadata["whole"] else float)


def test_parameters_cannot_be_changed():
    with pytest.raises(FrozenInstanceError):
        Parameters().detail = 1.0


def test_preset_of_the_paper():
    paper = Parameters.preset("Berretti 2009")
    assert paper.method == "berretti"
    assert paper.base_spacing == 0.005
    assert paper.equalize
    assert paper.n_slabs == 200
    assert paper.small_region == 0.05
    assert paper.concavity_weight == 0.5
    assert paper.follow_level_sets
    assert paper.detail == 0.5


@pytest.mark.parametrize("name", list(PRESETS))
def test_presets_can_be_changed(name):
    changed = Parameters.preset(name, detail=0.25, n_slabs=50)
    assert (changed.detail, changed.n_slabs) == (0.25, 50)
    assert changed.method == PRESETS[name].method
    with pytest.raises(ParameterError):
        Parameters.preset(name, detail=2)


def test_unknown_preset_lists_the_known():
    with pytest.raises(ParameterError) as caught:
        Parameters.preset("Berretti 2010")
    assert caught.value.name == "preset"
    assert all(name in str(caught.value) for name in PRESETS)


def test_names_of_the_first_version_are_understood_with_a_note():
    with pytest.warns(DeprecationWarning, match="is called") as notes:
        old = Parameters(levels=80, alpha=0.25, equalise=False)
    assert old == Parameters(n_slabs=80, concavity_weight=0.25, band_ratio=0.25, equalize=False)
    assert [str(note.message) for note in notes] == [
        "The parameter equalise is called equalize now.", "The parameter levels is called n_slabs now.",
        "The parameter alpha is called concavity_weight, band_ratio now."]
    with pytest.warns(DeprecationWarning, match="is called"):
        assert Parameters(alpha=0.25, band_ratio=1.0) == Parameters(concavity_weight=0.25, band_ratio=1.0)
    refused = pytest.raises(ParameterError, match="^n_slabs must be a number")
    with pytest.warns(DeprecationWarning, match="is called"), refused:
        Parameters(levels="many")
    with pytest.warns(DeprecationWarning, match="is called"):
        assert Parameters.preset("Berretti 2009", levels=50).n_slabs == 50


def test_todays_names_give_no_note(recwarn):
    Parameters.preset("Perceptual", n_slabs=50, equalize=False)
    assert not recwarn


@pytest.mark.parametrize("value", ["0.25", np.float32(0.25), np.array(0.25), Fraction(1, 4), Decimal("0.25"), " 0.25 "])
def test_numbers_of_other_kinds(value):
    taken = Parameters(detail=value)
    assert taken == Parameters(detail=0.25)
    assert type(taken.detail) is float


@pytest.mark.parametrize("value", ["50", 50.0, np.int8(50), np.float64(50), np.array(50), Fraction(50), "50.0"])
def test_whole_numbers_of_other_kinds(value):
    taken = Parameters(n_slabs=value)
    assert taken == Parameters(n_slabs=50)
    assert type(taken.n_slabs) is int


@pytest.mark.parametrize("value", [False, 0, np.False_, np.int64(0), np.array(False)])
def test_switches_of_other_kinds(value):
    assert Parameters(equalize=value).equalize is False


@pytest.mark.parametrize("value", ["yes", "0", 2, None, 0.5, [], {}, np.array([True]), object()], ids=repr)
def test_what_is_no_switch_is_refused(value):
    with pytest.raises(ParameterError, match="^equalize must be true or false, not ") as caught:
        Parameters(equalize=value)
    assert caught.value.name == "equalize"


@pytest.mark.parametrize("name", [*NUMBERS, "method", "pieces"])
@pytest.mark.parametrize("value", [{}, set(), 1j, 10**400, "1" * 400, b"x", np.array([0.5]), np.zeros((2, 2)), True,
                                   object(), np.datetime64(0, "s"), [[]], "{braces}", "nan"],
                                   ids=lambda v: type(v).__name__)
def test_odd_values_are_refused_in_a_short_sentence(name, value):
    with pytest.raises(ParameterError) as caught:
        Parameters(**{name: value})
    assert caught.value.name == name
    assert len(str(caught.value)) < 200


def test_words_of_numpy_are_words():
    taken = Parameters(method=np.str_("berretti"))
    assert type(taken.method) is str


def test_a_name_that_is_no_parameter():
    for make in (lambda: Parameters(nonsense=1), lambda: Parameters.preset("Perceptual", nonsense=1)):
        with pytest.raises(ParameterError, match="no parameter 'nonsense'") as caught:
            make()
        assert caught.value.name == "nonsense"
        assert isinstance(caught.value, TypeError)
    with pytest.raises(ParameterError, match="no parameter 'RANGES'"):
        Parameters(RANGES=1)
    for name in ([], None, {}, "x" * 1000):
        with pytest.raises(ParameterError, match="no preset"):
            Parameters.preset(name)


def test_parameters_are_taken_as_they_are_by_name_or_as_the_first_preset():
    given = Parameters(detail=0.25)
    assert Parameters.of(given) is given
    assert Parameters.of({"detail": 0.25}) == given
    assert Parameters.of(None) == Parameters.of({}) == Parameters() == PRESETS["Perceptual"]
    for value in (0.25, "Perceptual", [("detail", 0.25)], {1: 0.25}):
        with pytest.raises(ParameterError, match="^Parameters are given by their names, not as "):
            Parameters.of(value)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A second Ctrl+C while the first is heeded."""

from contextlib import contextmanager

import pytest

from core.interruptions import is_ending


@contextmanager
def cleaning(seen):
    """Notes in ``finally``, as what cleans up does, whether an interruption is being handled."""
    try:
        yield
    finally:
        seen.append(is_ending())
        try:
            raise FileNotFoundError
        except OSError:
            seen.append(is_ending())


@pytest.mark.parametrize(("error", "expected"), [(KeyboardInterrupt, True), (ValueError, False), (None, False)])
def test_known_wherever_it_is_handled(error, expected):
    seen = []
    try:
        with cleaning(seen):
            assert not is_ending()
            if error:
                raise error
    except (KeyboardInterrupt, ValueError):
        seen.append(is_ending())
    assert seen == [expected] * len(seen)
    assert not is_ending()

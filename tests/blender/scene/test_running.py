# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes on in the window in steps, and what else happens to Blender meanwhile."""

import importlib

import bpy
import pytest


@pytest.mark.parametrize("undo", ["undo", "redo"])
def test_what_is_written_in_steps_is_taken_back_before_undo(package, obj, undo):
    """As in another window: Separate went on writing to what undo had removed, and Blender crashed."""
    running, stepped, jobs = (importlib.import_module(f"{package}.scene.{name}")
                              for name in ("running", "stepped", "runs.jobs"))
    ended = []

    class Work(stepped.SteppedOperator):
        def steps(self, context):
            try:
                yield 0.5
            finally:
                ended.append(bpy.data.objects["Tree"].location.x)

    bpy.ops.ed.undo_push(message="Before")
    obj.location.x = 1.0
    bpy.ops.ed.undo_push(message="After")
    if undo == "redo":
        bpy.ops.ed.undo()
    work = Work()
    work._work, work._progress = work._in_transaction(bpy.context), jobs.Progress("")
    running._running.append((work, 0))  # as begun() does, where there is a window
    try:
        for _ in range(2):
            next(work._work)
        getattr(bpy.ops.ed, undo)()
    finally:
        running.ended(work)
    assert ended == [1.0 if undo == "undo" else 0.0]
    assert work._progress.cancelled

# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes on in the window in steps, and what else happens to Blender meanwhile."""

import importlib
from types import SimpleNamespace

import bpy
import pytest
import shapes


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


@pytest.mark.parametrize("at", [0.0, 0.3, 0.6])
def test_what_a_script_deletes_meanwhile_keeps_nothing_else_from_being_taken_back(package, make, caplog, at):
    """A timer of another extension may: then what was selected stayed deselected, and pieces were left."""
    separation, transaction, moved = (importlib.import_module(f"{package}.scene.{name}")
                                      for name in ("pieces.separation", "transaction", "changes.moved"))
    make(shapes.dumbbell(24, 10), "Other")
    tree = make(shapes.tube_tree())
    bpy.ops.reeb_parts.decompose(graph=False)
    bpy.data.objects["Other"].select_set(True)
    bpy.ops.object.select_all(action="SELECT")
    names = set(bpy.data.objects.keys()) - {"Tree"}
    style = SimpleNamespace(**{name: prop.default for name, prop in bpy.ops.reeb_parts.separate.get_rna_type()
                               .properties.items() if hasattr(prop, "default")})
    style.bed = (256.0, 256.0, 256.0)
    numbers = [part.number for part in tree.data.reeb_parts.parts]
    with pytest.raises(ReferenceError), transaction.transaction():
        for share in separation.separating(bpy.context, tree, moved.load(tree.data), numbers, style):
            if share >= at and "Tree" in bpy.data.objects:
                bpy.data.objects["Other"].select_set(False)
                bpy.data.meshes.remove(tree.data)
    assert set(bpy.data.objects.keys()) == names
    assert bpy.context.selected_objects == [bpy.data.objects["Other"]]
    assert not caplog.records

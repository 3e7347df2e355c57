# SPDX-License-Identifier: GPL-3.0-or-later
"""What all operators have in common: they tell the user what is wrong, in a tooltip before and in a report after."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.errors import ReebError
from ..core.sentence import Count
from . import store, targets
from .changes import moved
from .errors import SceneError, translated
from .modes import object_mode
from .result.part_list import check_parts
from .store import Stored
from .targets import Report
from .transaction import transaction

MOST_NAMES = 12  # that a report has; who needs the others finds them in the list of cuts, or by Check Parts


class ReportingOperator:
    """For operators that raise what the user should hear.

    A class that inherits gives ``run``, and ``check_context`` unless it works on the parts of the active object.
    """

    bl_options = {"REGISTER", "UNDO"}

    if TYPE_CHECKING:  # of bpy.types.Operator, which the class that inherits is, too

        def report(self, kind: set[str], message: str) -> None: ...

        @classmethod
        def poll_message_set(cls, message: str) -> None: ...

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        """Raise SceneError where the operator cannot be used: by default, where the active object has no parts."""
        check_parts(targets.active_object(context))

    def run(self, context: bpy.types.Context) -> set[str] | None:
        """Do what the operator is for; its result, None for FINISHED. Raises SceneError or ReebError."""
        raise NotImplementedError

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        try:
            cls.check_context(context)
        except SceneError as error:
            cls.poll_message_set(str(error))
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        # The redo panel takes back what was done, and calls at once: until then, no object knows where it is.
        context.evaluated_depsgraph_get()
        return self.attempt(self.run, context)

    def attempt(self, work: Callable[..., set[str] | None], *arguments: object) -> set[str]:
        """What a method returns, None for FINISHED; what it raises is reported, and the operator is cancelled.

        Whatever is raised, all that was written is taken back.
        """
        try:
            with transaction():
                return work(*arguments) or {"FINISHED"}
        except (SceneError, ReebError, MemoryError) as error:
            self.report({"ERROR"}, translated(error))
            return {"CANCELLED"}


class PartOperator(ReportingOperator):
    """For operators on the parts of the active object, in Object Mode. A class that inherits gives ``work``."""

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str | None:
        """Do what the operator is for; returns what to tell the user. Raises SceneError or ReebError."""
        raise NotImplementedError

    def run(self, context: bpy.types.Context) -> None:
        obj = targets.active_object(context)
        assert obj is not None  # check_context has looked
        with object_mode(context):
            message = self.work(context, obj, moved.load(obj.data))
        if message:
            self.report({"INFO"}, message)


class SelectedPartsOperator(PartOperator):
    """For operators on the parts of all selected objects, the active one first: of all, or of none if one fails.

    An object whose parts are out of date is left out, and it is said why, unless it is the active one. A class that
    inherits gives ``work``.
    """

    #: Whether what is made belongs to the mesh, so that objects that share one are a single one.
    one_per_mesh = True

    _tell: Report | None = None  # of the object whose turn it is

    def tell(self, kinds: set[str], message: str) -> None:
        """Report something of the object whose turn it is, by its name where there are several."""
        (self._tell or self.report)(kinds, message)

    def look(self, obj: bpy.types.Object) -> Stored:
        """The parts of an object whose turn has come; raises SceneError where it has to be left out."""
        return moved.load(obj.data)

    def run(self, context: bpy.types.Context) -> None:
        objects = chosen_with_parts(context, self.report, self.one_per_mesh)
        with object_mode(context):
            for obj, stored in targets.usable(objects, self.look, self.report):
                self._tell = telling_of(self.report, obj, len(objects) > 1)
                with named(obj, len(objects) > 1):
                    message = self.work(context, obj, stored)
                if message:
                    self.tell({"INFO"}, message)


def chosen_with_parts(context: bpy.types.Context, report: Report,
                      one_per_mesh: bool = True) -> list[bpy.types.Object]:
    """Those of ``targets.chosen_objects`` that have parts, be these out of date."""
    return [obj for obj in targets.chosen_objects(context, report, one_per_mesh) if store.has_result(obj.data)]


def with_current_parts(objects: list[bpy.types.Object],
                       report: Report) -> Iterator[tuple[bpy.types.Object, Stored]]:
    """Yield objects with their parts, without those whose parts are out of date; see ``targets.usable``."""
    return targets.usable(objects, lambda obj: moved.load(obj.data), report)


def listed(names: Sequence[str]) -> str:
    """Names as a report has them: of more than MOST_NAMES the first, and how many more there are."""
    shown = ", ".join(names[:MOST_NAMES])
    more = len(names) - MOST_NAMES
    return rpt_("{names} and {n} more").format(names=shown, n=more) if more > 0 else shown


def telling_of(report: Report, obj: bpy.types.Object, several: bool) -> Report:
    """A function that reports something of an object, with its name before it if there are several."""
    return (lambda kinds, message: report(kinds, f"{obj.name}: {message}")) if several else report


def report_kept(report: Report, n_kept: int) -> None:
    """Say how many objects of an earlier run were not replaced, if any."""
    if n_kept:
        report({"INFO"}, rpt_(
            "{n} earlier {n:object that was edited or is needed by others is left as it is|objects that were edited or "
            "are needed by others are left as they are}").format(n=Count(n_kept)))


@contextmanager
def named(obj: bpy.types.Object, several: bool) -> Iterator[None]:
    """Put the name of an object before the sentence that is raised, if there are several and it does not say it."""
    try:
        yield
    except (SceneError, ReebError) as error:
        words = translated(error)
        if not several or obj.name in words:
            raise
        raise SceneError(f"{obj.name}: {words}") from error

# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph as a handle: select a node or an arc, and the list chooses its part."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Vector

from ..scene import property_updates, targets, transaction
from ..scene.changes import edits, moved, reactions
from ..scene.errors import SceneError
from ..scene.graph import graph_finding, graph_objects
from ..scene.graph.graph_finding import part_of, source_of_arcs
from ..scene.modes import is_object_mode, object_mode
from ..scene.reporting import ReportingOperator, chosen_with_parts
from ..scene.result import part_names
from ..scene.result.part_list import check_parts, choose, chosen_numbers
from ..scene.showing.selection import select_objects
from ..viewport import pointing


class REEB_PARTS_OT_show_graph(ReportingOperator, bpy.types.Operator):
    """Show the Reeb graphs over the selected models, or hide them"""

    bl_idname = "reeb_parts.show_graph"
    bl_label = "Show or Hide Graph"

    def run(self, context: bpy.types.Context) -> None:
        shown = not graph_objects.is_shown(context, targets.active_object(context))

        def look(obj: bpy.types.Object) -> None:
            # What is drawn already can be hidden and shown also after an edit, when it may be in the way.
            if shown and graph_finding.find(obj) is None:
                with object_mode(context):
                    moved.load(obj.data)

        objects = chosen_with_parts(context, self.report, one_per_mesh=False)
        for obj, _ in targets.usable(objects, look, self.report):
            reactions.show_graph(obj, shown, context)
        transaction.keep_group(context.scene, "reeb_parts")
        with property_updates.quiet():  # what other models are shown with from now on
            context.scene.reeb_parts.graph = shown


class REEB_PARTS_OT_from_nodes(ReportingOperator, bpy.types.Operator):
    """Choose the parts of the selected nodes in the list, and make their object active"""

    bl_idname = "reeb_parts.from_nodes"
    bl_label = "Parts of Selected Nodes"

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        found = part_of(targets.active_object(context))
        if found is None:
            raise SceneError(rpt_("Select a node of a graph"))
        check_parts(found[0])

    def run(self, context: bpy.types.Context) -> None:
        found = part_of(targets.active_object(context))
        assert found is not None  # poll
        source, number = found
        parts = [part_of(item) for item in context.view_layer.objects.selected]
        others = [part[1] for part in parts if part and part[0] == source]
        choose(source.data, list(dict.fromkeys([number, *others])))
        select_objects(context, [source], active=source)


class REEB_PARTS_OT_from_arc(ReportingOperator, bpy.types.Operator):
    """Choose the part in which an arc was clicked, and make its object active"""

    bl_idname = "reeb_parts.from_arc"
    bl_label = "Part of Arc"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    location: bpy.props.FloatVectorProperty(
        name="Location", size=3, subtype="XYZ", description="A place on or beside the arc, in the world",
    )

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        source = source_of_arcs(targets.active_object(context))
        if source is None or not is_object_mode(context):
            raise SceneError(rpt_("Select the arcs of a graph"))
        check_parts(source)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self.attempt(self._run_at_pointer, context, event)

    def _run_at_pointer(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Blender has just selected the curve, by the last press of a button; the pointer may have gone on."""
        source = source_of_arcs(targets.active_object(context))
        assert source is not None  # poll
        pressed = event.mouse_prev_press_x, event.mouse_prev_press_y
        place = pointing.view_region(context.area, *pressed) if context.area else None
        if place is None:  # it was selected elsewhere, in the outliner
            return {"CANCELLED"}
        target = pointing.Model(source).under(context, source, *place, surface=False)
        if target is None:
            return {"CANCELLED"}
        self.location = source.matrix_world @ Vector(target.location)
        return self.execute(context)

    def run(self, context: bpy.types.Context) -> None:
        item = targets.active_object(context)
        source = source_of_arcs(item)
        assert item is not None  # poll
        assert source is not None
        model = pointing.Model(source)
        choose(source.data, [model.number(model.at(source, self.location, True))])
        item.select_set(False)
        source.select_set(True)
        context.view_layer.objects.active = source


class REEB_PARTS_OT_to_nodes(ReportingOperator, bpy.types.Operator):
    """Select the nodes of the chosen parts"""

    bl_idname = "reeb_parts.to_nodes"
    bl_label = "Nodes of Chosen Parts"

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        obj = targets.active_object(context)
        check_parts(obj)
        assert obj is not None  # check_parts has looked
        if obj.mode != "OBJECT":
            raise SceneError(rpt_("Go to Object Mode first"))
        if not graph_finding.exists(obj):
            raise SceneError(rpt_("The active object shows no graph"))

    def run(self, context: bpy.types.Context) -> None:
        obj = targets.active_object(context)
        assert obj is not None  # check_parts has looked
        graph_objects.select_nodes(obj, chosen_numbers(obj.data))


class REEB_PARTS_OT_split_at_node(ReportingOperator, bpy.types.Operator):
    """Split the part that holds the selected node, at the best cut along the node's arcs"""

    bl_idname = "reeb_parts.split_at_node"
    bl_label = "Split at Graph Node"

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        item = targets.active_object(context)
        if item is None or part_of(item) is None:
            raise SceneError(rpt_("Select a node of a graph"))
        if item.parent.mode != "OBJECT":
            raise SceneError(rpt_("Leave the object's mode first"))
        check_parts(item.parent)

    def run(self, context: bpy.types.Context) -> None:
        item = targets.active_object(context)
        assert item is not None  # check_context has looked
        mesh = item.parent.data
        number, new = edits.split_at_node(context, mesh, moved.load(mesh), item["node"])
        # The node's part is the one to go on with.
        choose(mesh, [item["part"]])
        self.report({"INFO"}, rpt_("{new} was cut from {name}").format(
            new=part_names.part_name(mesh, new), name=part_names.part_name(mesh, number)))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Every operator in every situation: it does its work and leaves all else alone, or says why it cannot.

And undo brings back exactly what was there before, redo what was there after. An operator that is new needs
a case here; what it does to the parts is tested elsewhere.

All but the newest Blender try a diagonal through the table of operators and situations: every operator once, every
situation at least once.
"""

import importlib
import re
from collections.abc import Callable
from dataclasses import dataclass, field

import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from diagonal import diagonal
from mathutils import Vector
from snapshot import activate, changes, snapshot

MODES = ("OBJECT", "EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT")
OTHER_MODES = MODES[1:]
FOLDER = "a folder for files"
LINKED = {"linked from a file": "is linked from .* Make it local"}
NO_NODE = {**LINKED, **dict.fromkeys(OTHER_MODES, "Select a node of a graph")}  # the mesh is active in its modes
WAYS_OF_OBJECTS = ("linked duplicate", "shared by three", "shape keys", "modifiers", "negative scale",
                   "hidden from render")
OUTSIDE = {mode: "Go to Object Mode first" for mode in OTHER_MODES}
SLOTS = ("/slots", "/attributes/material_index")


@dataclass(frozen=True)
class Case:
    """How an operator is called, and what it may do.

    Attributes
    ----------
    arguments : dict, or callable(obj) -> dict
    prepare : callable(obj)
        After Decompose, in Object Mode.
    parts : bool
        Whether the object is decomposed before.
    active : str
        "mesh", "node" or "arcs" of its graph, or "piece" that was separated from it.
    changes : tuple of str
        How the paths in the snapshot end of what is the user's and may change.
    refuses : dict of situation -> str
        What the sentence says there.
    """

    arguments: dict | Callable = field(default_factory=dict)
    prepare: Callable = lambda obj: None
    parts: bool = True
    active: str = "mesh"
    changes: tuple = ()
    refuses: dict = field(default_factory=lambda: LINKED)


def choose(*indices):
    """Mark parts of the list; the first is the active one."""
    def prepare(obj):
        result = obj.data.reeb_parts
        result.active = indices[0]
        for index, part in enumerate(result.parts):
            part.selected = index in indices
    return prepare


def choose_neighbours(obj):
    """Two parts that touch."""
    numbers = np.zeros(len(obj.data.polygons), np.int32)
    obj.data.attributes["reeb_part"].data.foreach_get("value", numbers)
    around = {}
    for polygon in obj.data.polygons:
        for key in polygon.edge_keys:
            around.setdefault(key, set()).add(int(numbers[polygon.index]))
    pair = next(found for found in around.values() if len(found) == 2)
    listed = [part.number for part in obj.data.reeb_parts.parts]
    choose(*(listed.index(number) for number in sorted(pair)))(obj)


def few_parts(obj):
    """Room to split and to grow."""
    obj.data.reeb_parts.n_parts = 3
    choose(0)(obj)


def many_small(obj):
    """So many parts that the list folds those under 10 %."""
    obj.data.reeb_parts.n_parts = 20
    bpy.context.scene.reeb_parts.small = 10.0


def small_part(obj):
    """The part with the smallest share is the active one."""
    shares = [part.share for part in obj.data.reeb_parts.parts]
    choose(shares.index(min(shares)))(obj)


def pinned(obj):
    """Parts changed by hand."""
    choose_neighbours(obj)
    bpy.ops.reeb_parts.merge()


def separated(obj):
    """Its pieces, and the original hidden."""
    bpy.ops.reeb_parts.separate()


def separated_and_back(obj):
    """The original is seen again, its pieces are hidden."""
    separated(obj)
    bpy.ops.reeb_parts.show_original()


def one_part(obj):
    """All of it is one part, which can be cut."""
    obj.data.reeb_parts.n_parts = 1


def named_beside_a_copy(obj):
    """A part has a name of its own, and there is a copy of the object with a mesh of its own."""
    obj.data.reeb_parts.parts[1].name = "Branch Part 1"  # which is known as ours
    other = obj.copy()
    other.data = obj.data.copy()
    bpy.context.scene.collection.objects.link(other)


def other_parameters(obj):
    """A scene whose parameters are not those of its preset."""
    bpy.context.scene.reeb_parts.equalize = False


def on_branch(obj):
    """A place half way out on a branch."""
    return {"location": obj.matrix_world @ Vector(0.7 * shapes.TREE_TIPS[0])}


def dab(obj):
    """A dab of the brush at two tips."""
    return {"stroke": [{"name": "", "location": tip, "radius": 0.3} for tip in shapes.TREE_TIPS[:2]]}


def face_set_painted(obj):
    """A face set of somebody's own over those of the parts."""
    bpy.ops.reeb_parts.face_sets()
    values = np.zeros(len(obj.data.polygons), np.int32)
    sets = obj.data.attributes[".sculpt_face_set"].data
    sets.foreach_get("value", values)
    values[values == 1] = np.where(np.arange((values == 1).sum()) < 40, 77, 1)
    sets.foreach_set("value", values)


CASES = {
    "decompose": Case({"detail": 0.6}, parts=False, changes=("/active color", "/render color")),
    "cancel": Case(parts=False, refuses={}),
    "clear": Case(changes=("/active color", "/render color")),
    "use_preferences": Case(parts=False, changes=("/settings",), refuses={}),
    "reset_parameters": Case(parts=False, prepare=other_parameters, changes=("/settings",), refuses={}),
    "step_detail": Case(prepare=few_parts),
    "select": Case(prepare=choose(1), changes=("/flags/.* select", "/attributes/.select_.*")),
    "isolate": Case(prepare=choose(1), changes=("/flags/.* hide", "/attributes/.hide_.*", "/modifiers")),
    # In Edit Mode, what is hidden is not selected any more, as after Blender's own H.
    "hide": Case(prepare=choose(1), changes=("/flags/.* (hide|select)", "/attributes/.(hide|select)_.*", "/order",
                                             "/modifiers")),
    "rename": Case({"new_name": "Branch Part 1"}, prepare=choose(1)),
    "choose": Case(refuses={**dict.fromkeys((*MODES, *WAYS_OF_OBJECTS), "This works over a 3D viewport"), **LINKED}),
    "no_key": Case(),
    "mark": Case({"action": "FACES"}),
    "release": Case(prepare=pinned),
    "merge": Case(prepare=choose_neighbours),
    "merge_neighbour": Case(prepare=small_part),
    "merge_small": Case(prepare=many_small),
    "frame": Case(prepare=choose(1)),
    "split": Case(prepare=few_parts),
    "grow": Case(prepare=few_parts),
    "shrink": Case(prepare=few_parts),
    "assign": Case({"new": True}),
    "from_face_sets": Case(prepare=face_set_painted, changes=("/attributes/.sculpt_face_set",)),
    "pick": Case(on_branch),
    "cut": Case(on_branch, prepare=one_part),
    "paint": Case(dab),
    "slide": Case({"offset": 0.1}, prepare=small_part),
    "from_nodes": Case(active="node", changes=("/active", "/selected"), refuses=NO_NODE),
    "from_arc": Case(on_branch, active="arcs", changes=("/active", "/selected"),
                     refuses={**LINKED, **dict.fromkeys(OTHER_MODES, "Select the arcs of a graph")}),
    "to_nodes": Case(refuses={**LINKED, **OUTSIDE}),
    "split_at_node": Case(active="node", refuses=NO_NODE),
    "separate": Case({"caps": True}, changes=("/active", "/selected", "/Tree.*/hidden", "/Tree.*/mode",
                                            "/data/shape_keys")),
    "show_pieces": Case(prepare=separated_and_back, changes=("/active", "/selected", "/Tree.*/hidden"),
                        refuses={**LINKED, **OUTSIDE}),
    "show_original": Case(prepare=separated, active="piece", changes=("/active", "/selected", "/Tree.*/hidden"),
                          refuses={**LINKED, **OUTSIDE}),
    "check_pieces": Case(prepare=separated, active="piece", refuses={**LINKED, **OUTSIDE}),
    "select_faults": Case({"kind": "THIN"}, prepare=separated, active="piece", refuses={**LINKED, **OUTSIDE}),
    "repair_piece": Case(prepare=separated, active="piece", changes=("/data/shape_keys",),
                         refuses={**LINKED, **OUTSIDE}),
    "seams": Case(changes=("/seams", "/attributes/.?uv_seam")),
    "face_sets": Case(changes=("/attributes/.sculpt_face_set",)),
    "materials": Case(changes=SLOTS),
    "unwrap": Case(changes=("/active UV map",)),
    "export": Case({"directory": FOLDER, "format": "ply"}),
    "armature": Case(changes=("/modifiers",)),
    "hulls": Case(),
    "rigid_bodies": Case(prepare=separated, active="piece", changes=("/data/collections", "/collections/RigidBody.*"),
                         refuses=LINKED),
    "show_colors": Case(refuses={}),
    "suggest_names": Case(),
    "show_graph": Case(changes=("/settings",)),
    "find_similar": Case(prepare=choose(1)),
    "names_from_active": Case({"everywhere": True}, prepare=named_beside_a_copy),
}


def duplicated(obj):
    bpy.ops.object.duplicate(linked=True)


def shared(obj):
    for name in ("Second", "Third"):
        other = bpy.data.objects.new(name, obj.data)
        other.location.x = 5
        bpy.context.scene.collection.objects.link(other)


def with_shape_keys(obj):
    obj.shape_key_add(name="Basis")
    for name, value, axis in (("Long", 0.5, 2), ("Wide", 0.25, 0)):
        key = obj.shape_key_add(name=name, from_mix=False)
        points = np.array([vertex.co[:] for vertex in obj.data.vertices], np.float32)
        points[:, axis] *= 1.5
        key.data.foreach_set("co", points.ravel())
        key.value = value
    obj.data.shape_keys.key_blocks["Wide"].vertex_group = "Arm"


def with_modifiers(obj):
    obj.modifiers.new("Smooth", "SUBSURF").levels = 1
    obj.modifiers.new("Twin", "MIRROR").use_axis[1] = True


def mirrored(obj):
    obj.scale, obj.rotation_euler = (-1.5, 0.5, 2.0), (0.3, 0.2, 0.1)
    bpy.context.view_layer.update()


def hidden_from_render(obj):
    collection = bpy.data.collections.new("Not rendered")
    collection.hide_render = True
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)


BEFORE = {"linked duplicate": duplicated, "shared by three": shared, "shape keys": with_shape_keys,
          "modifiers": with_modifiers, "negative scale": mirrored, "hidden from render": hidden_from_render}
SITUATIONS = (*MODES, *BEFORE, "linked from a file")


def furnish(obj):
    """All sorts of things that are the user's own."""
    mesh = obj.data
    rng = np.random.default_rng(0)
    mesh.uv_layers.new(name="Map").data.foreach_set("uv", rng.random(2 * len(mesh.loops)).astype(np.float32))
    paint = mesh.color_attributes.new("Paint", "BYTE_COLOR", "CORNER")
    paint.data.foreach_set("color", rng.random(4 * len(mesh.loops)).astype(np.float32))
    mesh.attributes.new("wear", "FLOAT", "POINT").data.foreach_set("value", rng.random(len(mesh.vertices)))
    mesh.attributes.new(".sculpt_face_set", "INT", "FACE").data.foreach_set(
        "value", rng.integers(1, 9, len(mesh.polygons)))
    for name in ("Skin", "Nail"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", rng.integers(0, 2, len(mesh.polygons)))
    mesh.edges.foreach_set("use_seam", rng.random(len(mesh.edges)) < 0.1)
    obj.vertex_groups.new(name="Arm").add(range(0, len(mesh.vertices), 3), 0.25, "REPLACE")
    mesh["mine"], obj["mine"] = 1.5, "text"
    points = np.array([vertex.co[:] for vertex in mesh.vertices])
    flag(mesh, "select", np.linalg.norm(points - points[0], axis=1) < 0.3, np.all)
    flag(mesh, "hide", np.linalg.norm(points - points[-1], axis=1) < 0.2, np.any)
    collection = bpy.data.collections.new("Mine")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(bpy.data.objects.new("Bystander", bpy.data.meshes.new("Bystander")))


def flag(mesh, name, vertices, rule):
    """Select or hide vertices, and the edges and faces that then are so too in Edit Mode."""
    mesh.vertices.foreach_set(name, vertices)
    for items, width in ((mesh.edges, 2), (mesh.polygons, 3)):
        items.foreach_set(name, rule(vertices[read(items, "vertices", np.int32, width)], axis=1))


OURS = re.compile(r"\.?reeb_|Reeb |([\w.]+ |DEF-)?Parts? \d|Parts of |UCX_|"
                  r"body|.*(limb|tip|piece|joint|middle)(\.\w+)*$")  # nodes, and names that are suggested
RESULT = ("result", "made", "users")  # what an operator writes by rights, and what counts its pieces
FLAGS = re.compile(r"\.select_|\.hide_|\.?uv_seam|\.uv_select|sharp_|material_index")


def users_own(shot):
    """A snapshot without what carries our names."""
    if isinstance(shot, dict):
        return {name: users_own(value) for name, value in shot.items() if name not in RESULT and not is_ours(name)
                and not (FLAGS.match(name) and (value is None or value[2] is None or ".uv_select" in name))}
    if isinstance(shot, list):
        return [item for item in shot if not is_ours(item[0] if isinstance(item, tuple) else item)]
    return shot


def is_ours(name):
    return isinstance(name, str) and OURS.match(name) is not None


def set_up(package, name, situation, make, tree, tmp_path):
    """The scene for an operator in a situation; returns the arguments to call it with."""
    case = CASES[name]
    furnish(make(tree))
    BEFORE.get(situation, lambda obj: None)(bpy.context.object)
    obj = bpy.context.object
    if case.parts:
        bpy.ops.reeb_parts.decompose()
    case.prepare(obj)
    arguments = case.arguments(obj) if callable(case.arguments) else case.arguments
    node = next((item.name for item in obj.children if item.get("kind") == "saddle" and not item["folded"]), "")
    active = {"mesh": obj.name, "node": node, "arcs": "Reeb arcs", "piece": f"{obj.name} Part 01"}[case.active]
    if situation == "linked from a file":
        link_from_file(tmp_path / "library.blend", active)
    elif case.active == "piece" or situation not in OTHER_MODES:
        activate(bpy.data.objects[active])
    if situation in MODES:
        bpy.ops.object.mode_set(mode=situation)
    if name == "cancel":
        jobs = importlib.import_module(f"{package}.scene.runs.jobs")
        jobs.current = jobs.Job([], None)
    return {key: str(tmp_path / "parts") if value is FOLDER else value for key, value in arguments.items()}


def link_from_file(path, active):
    """Save the file, and link all of its scene into an empty one."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    names = [obj.name for obj in bpy.context.scene.objects]
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(str(path), link=True) as (_, loaded):
        loaded.objects = list(names)
    for name in names:
        bpy.context.scene.collection.objects.link(bpy.data.objects[name])
    activate(bpy.data.objects[active])


@pytest.fixture
def no_job(package):
    """Nothing is being computed when the test is over."""
    yield
    importlib.import_module(f"{package}.scene.runs.jobs").current = None


@pytest.fixture(scope="module")
def tree():
    """A trunk with branches."""
    return shapes.tube_tree(step=0.2)


def test_every_operator_has_a_case(package):
    classes = importlib.import_module(f"{package}.operators").CLASSES
    names = {cls.bl_idname.split(".")[1] for cls in classes if issubclass(cls, bpy.types.Operator)}
    assert names - set(CASES) == set(), "these operators need a Case in tests/blender/operators/test_every_operator.py"
    assert set(CASES) - names == set(), "these operators are gone"


def table():
    """The pairs of a situation and an operator that are tried."""
    first = diagonal()
    if first is None:
        return [(situation, name) for situation in SITUATIONS for name in CASES]
    return [(SITUATIONS[(first + i) % len(SITUATIONS)], name) for i, name in enumerate(CASES)]


@pytest.mark.parametrize(("situation", "name"), table())
def test_it_works_or_says_why_not_and_can_be_undone(package, name, situation, make, tree, tmp_path, no_job):
    arguments = set_up(package, name, situation, make, tree, tmp_path)
    operator, case = getattr(bpy.ops.reeb_parts, name), CASES[name]
    bpy.ops.ed.undo_push(message="before")
    before, active = snapshot(), bpy.context.view_layer.objects.active.session_uid
    if situation in case.refuses:
        with pytest.raises(RuntimeError) as error:
            operator(**arguments)
        sentence = re.sub(r"Operator bpy.ops.\S+ |Error: ", "", str(error.value)).strip()
        assert re.search(case.refuses[situation], sentence)
        assert "\n" not in sentence
        assert changes(before, snapshot()) == []
        return
    assert operator(**arguments) == {"FINISHED"}
    bpy.ops.ed.undo_push(message="after")
    after = snapshot()
    allowed = re.compile("|".join(f".*{path}$" for path in case.changes) or "$^")
    found = [c for c in changes(users_own(before), users_own(after)) if not allowed.match(c[0])]
    if case.active == "node" and bpy.context.view_layer.objects.active.session_uid == active:
        found = [c for c in found if c[0] != "/active"]  # it has the name of the part that it is in now
    assert found == []
    bpy.ops.ed.undo()
    assert changes(before, snapshot()) == []
    bpy.ops.ed.redo()
    assert changes(after, snapshot()) == []


@pytest.mark.parametrize(("name", "choice"), [("isolate", "show_all"), ("release", "everything"), ("assign", "new")])
def test_a_command_does_what_its_name_says_whatever_another_button_of_it_did_before(package, name, choice):
    """After *Show All*, *Isolate Parts* found by F3 showed all; the others did so, too.

    Only in a window does Blender keep such choices for the next call.
    """
    assert getattr(bpy.ops.reeb_parts, name).get_rna_type().properties[choice].is_skip_save


@pytest.mark.parametrize("name", ["export", "materials", "select_faults", "separate", "show_colors"])
def test_scripts_that_run_in_a_timer_have_no_window(package, name, make, tree, tmp_path):
    """There, Blender's context has no active object, and its own operators refuse."""
    arguments = set_up(package, name, "SCULPT" if name == "separate" else "OBJECT", make, tree, tmp_path)
    with bpy.context.temp_override(window=None):
        assert getattr(bpy.ops.reeb_parts, name)(**arguments) == {"FINISHED"}
    if name == "separate":
        tree_object = bpy.data.objects["Tree"]
        assert (tree_object.mode, tree_object.hide_get()) == ("OBJECT", True)

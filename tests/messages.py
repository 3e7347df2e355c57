# SPDX-License-Identifier: GPL-3.0-or-later
"""Every message of the extension that Blender or the extension itself looks up in a dictionary.

A message is (context, English text). Labels and tooltips are read from what is registered, all else from
the code: literals in calls of ``rpt_``, ``iface_`` and ``n_``, in ``text=`` and ``heading=`` of a layout,
and in what ``core`` calls its sentences and stages.
"""

import ast
import sys
from pathlib import Path

import bpy

PACKAGES = ("core", "scene", "viewport", "operators", "ui")
LOOK_UPS = {"iface_", "rpt_", "tip_", "n_"}
WORDS_OF_LAYOUT = {"text", "heading"}  # arguments that Blender looks up, unless told not to
STAGES = {"stage", "progress"}  # functions of core that take the name of a stage
ERRORS = {"ReebError", "MeshError", "EmptyMeshError", "DisconnectedMeshError", "ParameterError"}  # of core
#: Methods of operators whose result reaches the user: in a report, in the status bar.
RETURN_TOLD = {"work", "hint"}
#: Functions whose arguments reach the user as they are, by where the text is.
TOLD = {"report": 1, "SceneError": 0, "poll_message_set": 0, "status_text_set": 0}


def sources(package) -> dict:
    """The parsed files of the extension, by their path below it."""
    root = Path(sys.modules[package].__file__).parent
    return {
        path.relative_to(root).as_posix(): ast.parse(path.read_text(encoding="utf-8"))
        for name in PACKAGES for path in sorted((root / name).rglob("*.py"))
    }


def registered_messages(package) -> set:
    """Of our classes and what they are made of."""
    found = set()
    for cls in _classes(package):
        rna = cls.bl_rna
        if issubclass(cls, bpy.types.Operator):
            rna = getattr(bpy.ops.reeb_parts, cls.bl_idname.removeprefix("reeb_parts.")).get_rna_type()
            found |= {(rna.translation_context, rna.name), ("*", rna.description)}
        elif issubclass(cls, (bpy.types.Panel, bpy.types.Menu)):
            found |= {(rna.translation_context, cls.bl_label), ("*", getattr(cls, "bl_category", ""))}
        for prop in _own_properties(cls, rna):
            found |= _property_messages(prop)
    return {(context, text) for context, text in found if text}


def _classes(package) -> list:
    """Our registered classes that have words."""
    kinds = ("Operator", "Panel", "Menu", "PropertyGroup", "AddonPreferences")
    return [cls for kind in kinds for cls in getattr(bpy.types, kind).__subclasses__()
            if cls.__module__.startswith(package) and cls.is_registered]


def _own_properties(cls, rna) -> list:
    """Properties that are not those of every class of this sort."""
    common = {prop.identifier: prop.description for prop in rna.base.properties} if rna.base else {}
    # Blender 5.3 describes the name of every group in two ways.
    return [prop for prop in rna.properties if prop.identifier != "rna_type"
            and common.get(prop.identifier) != prop.description
            and not prop.description.startswith("Unique name used in the code and scripting")]


def _property_messages(prop) -> set:
    context = prop.translation_context
    # Blender calls a property that has no name by its identifier.
    name = "" if prop.name == prop.identifier else prop.name
    found = {(context, name), ("*", prop.description)}
    if prop.type == "ENUM":
        for item in prop.enum_items:
            found |= {(context, item.name), ("*", item.description)}
    return found


def written_messages(trees) -> set:
    """Of the code. trees : as from ``sources``."""
    found = set()
    for path, tree in trees.items():
        core = path.startswith("core/")
        for call in calls(tree):
            found |= _core_messages(call) if core else _call_messages(call)
            if name_of(call) == "Sentence":
                found.add(("*", literal(call.args[0])))
    return {(context, text) for context, text in found if text and any(map(str.isalpha, text))}


def _core_messages(call) -> set:
    if isinstance(call.func, ast.Attribute) and call.func.attr in STAGES and call.args:
        return {("*", literal(call.args[0]))}
    return set()


def _call_messages(call) -> set:
    if name_of(call) in LOOK_UPS and call.args:
        context = literal(call.args[1]) if len(call.args) > 1 else "*"
        return {(context, literal(call.args[0]))}
    # Buttons are looked up as operators are, unless told otherwise.
    context = "Operator" if name_of(call).startswith("operator") else "*"
    context = next((literal(keyword.value) for keyword in call.keywords if keyword.arg == "text_ctxt"), context)
    return {(context, literal(keyword.value)) for keyword in call.keywords if keyword.arg in WORDS_OF_LAYOUT}


def calls(tree) -> list:
    """All calls in some code."""
    return [node for node in ast.walk(tree) if isinstance(node, ast.Call)]


def name_of(call) -> str:
    """What is called: the last name of it."""
    return getattr(call.func, "attr", None) or getattr(call.func, "id", "")


def literal(node) -> str:
    """The text of a string literal, "" for anything else."""
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def made_here(trees) -> list:
    """Places where text reaches the user that nobody can translate: (path, line, code)."""
    found = []
    for path, tree in trees.items():
        for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
            for node in _shown(function):
                found += [(path, bad) for bad in _untranslated(node, function)]
    return [(path, node.lineno, ast.unparse(node)) for path, node in found]


def _shown(function) -> list:
    """Expressions of a function that the user reads."""
    shown = []
    for call in calls(function):
        place = 0 if name_of(call) in ERRORS else TOLD.get(name_of(call))
        if place is not None:
            shown += call.args[place : place + 1]
        # Literals here are looked up by Blender.
        shown += [k.value for k in call.keywords if k.arg in WORDS_OF_LAYOUT and not literal(k.value)]
    if function.name in RETURN_TOLD:
        shown += [node.value for node in ast.walk(function) if isinstance(node, ast.Return) and node.value]
    return shown


def _untranslated(node, function, seen=()) -> list:
    """Literals with letters in an expression, and in what its names stand for, that are not looked up."""
    if isinstance(node, ast.Call) and name_of(node) in {*LOOK_UPS, "Sentence"}:
        return [] if node.args and not isinstance(node.args[0], ast.JoinedStr) else [node]
    if isinstance(node, (ast.Constant, ast.JoinedStr)):
        parts = node.values if isinstance(node, ast.JoinedStr) else [node]
        return [node] if any(map(str.isalpha, "".join(map(literal, parts)))) else []
    if isinstance(node, ast.Name):
        return [] if node.id in seen else [
            bad for assigned in ast.walk(function)
            if isinstance(assigned, ast.Assign) and any(getattr(t, "id", "") == node.id for t in assigned.targets)
            for bad in _untranslated(assigned.value, function, (*seen, node.id))
        ]
    if isinstance(node, (ast.Subscript, ast.Attribute)):
        return []
    if isinstance(node, ast.Call):  # of another function: what it is given is not shown, but what is formatted
        inner = [node.func.value] if isinstance(node.func, ast.Attribute) and node.func.attr == "format" else []
        return [bad for part in inner for bad in _untranslated(part, function, seen)]
    return [bad for child in ast.iter_child_nodes(node) for bad in _untranslated(child, function, seen)]

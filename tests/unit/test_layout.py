# SPDX-License-Identifier: GPL-3.0-or-later
"""The layout of the product: imports go downwards only, and operators live in operators/.

Imports are read from the syntax trees of all files, those inside functions and for type checkers included.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: The folders, and what a file in each may import from besides its own folder.
MAY_IMPORT = {
    "core": set(),
    "scene": {"core"},
    "viewport": {"core", "scene"},
    "operators": {"core", "scene", "viewport"},
    "ui": {"core", "scene"},
    "batch": {"core", "scene"},
    "package": {"core"},
}
#: The stages of core, in the order in which the method takes them: a stage may import itself and earlier ones.
STAGES = ("arrays", "mesh", "surface", "symmetry", "field", "graph", "cuts", "result", "uses")
#: Modules of core that all of core may import; they import only each other.
COMMON = {"errors", "sentence", "parameters", "processors", "steps", "version"}
#: Modules of core that may import everything in it.
DOORS = {"__init__", "pipeline", "handover", "worker"}

FILES = {path.relative_to(ROOT): ast.parse(path.read_text(encoding="utf-8"))
         for folder in MAY_IMPORT for path in sorted((ROOT / folder).rglob("*.py"))}
#: The folders whose docstrings have a line for each module.
DESCRIBED = [path.parent for path in FILES
             if path.parts[0] in {"core", "scene", "viewport"} and path.name == "__init__.py"]


def absolute(path: Path, level: int, module: str | None) -> tuple[str, ...]:
    """Where in the product a relative import of a file leads, as folders and a module."""
    package = path.parent.parts
    found = (*package[: len(package) - level + 1], *(module.split(".") if module else ()))
    # Installed, core lies in the package.
    return found[1:] if found[:2] == ("package", "core") else found


def imported(path: Path, tree: ast.AST) -> set[tuple[str, ...]]:
    """Modules of the product that a file imports, and of others the names, each as a tuple of its parts."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {tuple(alias.name.split(".")) for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found.add(tuple(node.module.split(".")))
        elif isinstance(node, ast.ImportFrom):
            base = absolute(path, node.level, node.module)
            # What is imported from a folder may be a module or a name that its __init__ has.
            found |= {(*base, alias.name) if is_module((*base, alias.name)) else base for alias in node.names}
    return {module for module in found if module}


def is_module(parts: tuple[str, ...]) -> bool:
    """Whether there is a module or a folder of the product of that name."""
    return ROOT.joinpath(*parts).with_suffix(".py").is_file() or (ROOT.joinpath(*parts) / "__init__.py").is_file()


def violations(allowed) -> list[str]:
    """Imports of the product's own modules that are not allowed. allowed : callable(path, module) -> bool"""
    return [f"{path} imports {'.'.join(module)}" for path, tree in FILES.items()
            for module in sorted(imported(path, tree)) if module[0] in MAY_IMPORT and not allowed(path, module)]


def test_imports_are_resolved():
    path = Path("scene/outputs/x.py")
    tree = ast.parse("from ...core.errors import ReebError\ndef f():\n    from .. import store\n"
                     "    from .write import x\nimport bpy.types\nfrom numpy.linalg import norm\n"
                     "from . import colors, update_outputs")
    assert imported(path, tree) == {
        ("core", "errors"), ("scene", "store"), ("scene", "outputs", "write"), ("bpy", "types"), ("numpy", "linalg"),
        ("scene", "outputs", "colors"), ("scene", "outputs"),
    }
    tree = ast.parse("from ..core.errors import ReebError\nfrom . import decompose\nfrom ..meshes import face_colors")
    assert imported(Path("package/command/x.py"), tree) == {
        ("core", "errors"), ("package", "command", "decompose"), ("package", "meshes")}


def test_there_are_files_in_every_folder_and_stage():
    assert {path.parts[0] for path in FILES} == set(MAY_IMPORT)
    assert {path.parts[1] for path in FILES if path.parts[0] == "core" and len(path.parts) > 2} == set(STAGES)


def test_folders_import_downwards_only():
    assert violations(lambda path, module: module[0] in {path.parts[0], *MAY_IMPORT[path.parts[0]]}) == []


def test_blender_comes_up_without_scipy():
    """What operators and panels import before any function of theirs is called."""
    waiting, seen = [path for path in FILES if path.parts[0] in {"operators", "ui"}], {}
    while waiting:
        path = waiting.pop()
        at_once = [node for node in FILES[path].body if isinstance(node, ast.Import | ast.ImportFrom)]
        seen[path] = imported(path, ast.Module(at_once, []))
        places = {Path(*module[:n]) for module in seen[path] for n in range(1, len(module) + 1)}
        files = {file for place in places for file in (place.with_suffix(".py"), place / "__init__.py")}
        waiting += (files & FILES.keys()) - seen.keys()
    assert Path("scene/runs/succession.py") in seen
    assert [str(path) for path, modules in seen.items() if "scipy" in {module[0] for module in modules}] == []


def test_stages_of_core_import_earlier_stages_only():
    def allowed(path, module):
        if path.parts[0] != "core":
            return True
        own, other = path.with_suffix("").parts[1], (*module[1:], "__init__")[0]
        if own in DOORS or other in COMMON:
            return own not in COMMON or other in COMMON
        if own == "metrics":  # compares labels of any origin
            return other in {"arrays", "mesh"}
        return own in STAGES and other in STAGES[: STAGES.index(own) + 1]

    assert violations(allowed) == []


@pytest.mark.parametrize("folder", DESCRIBED, ids=str)
def test_a_folder_names_each_of_its_modules_and_no_others(folder):
    rows = re.findall(r"^- ``(\w+)``: ", ast.get_docstring(FILES[folder / "__init__.py"]), re.MULTILINE)
    there = {path.stem for path in FILES if path.parent == folder} - {"__init__"}
    folders = {path.parent.name for path in FILES if path.name == "__init__.py" and path.parent.parent == folder}
    assert sorted(rows) == sorted(there | folders)


def test_core_knows_no_blender():
    blender = {"bpy", "bmesh", "mathutils", "gpu", "gpu_extras", "bpy_extras"}
    found = {str(path): imported(path, tree) for path, tree in FILES.items() if path.parts[0] == "core"}
    assert [path for path, modules in found.items() if blender & {module[0] for module in modules}] == []


def makes_numbers_of_any_width(node: ast.AST) -> bool:
    """Whether an expression calls NumPy for whole numbers of as many bits as the system likes."""
    if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)):
        return False
    name = node.func.attr
    values, said = list(map(ast.unparse, node.args)), {word.arg: ast.unparse(word.value) for word in node.keywords}
    if name in {"arange", "indices"}:
        return "dtype" not in said and len(values) < {"arange": 4, "indices": 2}[name]
    if name == "full" and len(values) == 2 and re.fullmatch(r"-?\d+|len\(.*\)", values[1]):
        return "dtype" not in said
    return "int" in {*values, said.get("dtype")} and name in {"array", "asarray", "astype", "empty", "ones", "zeros"}


def test_whole_numbers_are_of_64_bits_on_every_system():
    """What is made without saying so is of 32 in Blender 4.2 and 4.5 for Windows: see core.arrays.int64."""
    found = [f"{path}:{node.lineno}" for path, tree in FILES.items() if path.name != "int64.py"
             for node in ast.walk(tree) if makes_numbers_of_any_width(node)]
    assert found == []


def test_only_the_script_that_a_blender_runs_for_the_package_imports_it():
    paths = [path.as_posix() for path, tree in FILES.items() if path.parts[0] == "package"
             and "bpy" in {module[0] for module in imported(path, tree)}]
    assert paths == ["package/blender_export.py"]


def is_operator(node: ast.AST) -> bool:
    """Whether something is a class that Blender registers as an operator."""
    return isinstance(node, ast.ClassDef) and any(ast.unparse(base).endswith("types.Operator") for base in node.bases)


@pytest.mark.parametrize("path", [path for path in FILES if path.name != "__init__.py"], ids=str)
def test_operators_are_in_their_folder_and_nothing_else(path):
    has_operators = any(is_operator(node) for node in ast.walk(FILES[path]))
    assert has_operators == (path.parts[0] == "operators")

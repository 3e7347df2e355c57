# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the command; parameters and switches are made from their definitions."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from ..core.options import add_parameters, dashed, limits_of, named_file, named_folder, number
from ..scene.properties import SEPARATE, HintProperties, JointProperties, OutputProperties, OverlayProperties
from ..scene.saving.export import KINDS
from .importers import IMPORTERS, WITHOUT_UNIT
from .models import UNITS

PIXELS = number(16, 8192, int)


def parser(description: str | None) -> argparse.ArgumentParser:
    """All options. description : what the help begins with."""
    made = argparse.ArgumentParser(
        prog="blender --command reeb_parts", description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument("models", nargs="*", type=Path, metavar="MODEL",
                      help=f"a scene (.blend), or one or several models ({', '.join(IMPORTERS)}); without it, the "
                      "scene that Blender has open")
    made.add_argument("--object", action="append", default=[], metavar="NAME",
                      help="object to decompose, can be given several times; * ? [abc] stand for any letters, one, and "
                      "one of these, so that \"*\" is every mesh of a scene; the active object of a scene and every "
                      "mesh of a model file without")
    made.add_argument("--unit", choices=UNITS, help=f"what a length of 1 in {', '.join(WITHOUT_UNIT)} is (default: m; "
                      "what slicers read is in mm)")
    _add_files(made.add_argument_group("files to write"))
    _add_uses(made.add_argument_group("what is made of the parts"))
    parameters = made.add_argument_group("parameters")
    add_parameters(parameters)
    hints = HintProperties.__annotations__["hints"].keywords
    parameters.add_argument("--hints", choices=[item[0].lower() for item in hints["items"]], default="none",
                            help=hints["description"] + " (default: %(default)s)")
    _add_outputs(made.add_argument_group("what is written to the objects"))
    return made


def _add_files(files: argparse._ArgumentGroup) -> None:
    files.add_argument("--save", type=named_file, metavar="OUT.blend", help="the scene with the parts in it")
    files.add_argument("--json", type=named_file, metavar="OUT.json",
                       help="the JSON that also goes to standard output")
    files.add_argument("--labels", action="store_true", help="also list the part of every face in the JSON")
    files.add_argument("--check", action="store_true",
                       help="also say of each part in the JSON whether its piece, with holes closed, is sound")
    files.add_argument("--parts", type=named_folder, metavar="DIR", help="a file for each part, in a folder")
    files.add_argument("--parts-format", choices=[kind for kind, _, _ in KINDS], default="obj",
                       help="format of those files (default: %(default)s)")
    files.add_argument("--threemf", type=named_file, metavar="OUT.3mf",
                       help="all parts, closed, for slicers: one assembly for each object, with names and colors")
    files.add_argument("--picture", type=named_file, metavar="OUT.png", help="a picture of the parts with the graph")
    files.add_argument("--picture-turn", type=number(-36000.0, 36000.0), default=0.0, metavar="DEGREES",
                       help="turn its camera, which looks at the front, around the objects (default: 0)")
    files.add_argument("--picture-size", type=_size, default=(960, 540), metavar="WxH",
                       help="its width and height in pixels, 16 to 8192 each (default: 960x540)")


def _add_uses(uses: argparse._ArgumentGroup) -> None:
    cut = SEPARATE["cut"].keywords
    uses.add_argument("--separate", action="store_true", help="an object for each part, in the scene to save")
    uses.add_argument("--cuts", choices=[item[0].lower() for item in cut["items"]],
                      help=f"{cut['description']}; so in files, too (default: {cut['default'].lower()}; parts in files "
                      "that are not separated along faces)")
    uses.add_argument("--caps", action="store_true", help="close the holes of these objects")
    uses.add_argument("--cap-material", action="store_true",
                      help="close them, and give the new faces a material of their own, Cap")
    _add_pegs(uses)
    uses.add_argument("--bed", nargs=3, type=number(1.0, 100000.0), metavar=("X", "Y", "Z"),
                      help="cut them further where they do not fit into a box of so many millimeters (1 to 100000)")
    uses.add_argument("--unwrap", action="store_true", help="a UV map with an island for each part")
    uses.add_argument("--armature", action="store_true", help="a bone for each part, and weights to pose it with")
    uses.add_argument("--hulls", choices=("unreal", "godot"), metavar="ENGINE",
                      help="a convex hull of each part, named for unreal or godot")
    uses.add_argument("--hulls-per-part", type=int, choices=range(1, 9), default=1, metavar="N",
                      help="so many where one hull fits a part badly, 1 to 8 (default: %(default)s)")
    uses.add_argument("--rigid-bodies", choices=("hinge", "point", "fixed"), nargs="?", const="hinge", metavar="KIND",
                      help="make rigid bodies of these objects, held together at the cuts by hinge, point or fixed "
                      "(default: hinge)")


def _add_pegs(uses: argparse._ArgumentGroup) -> None:
    joint = JointProperties.__annotations__
    kinds = [item[0].lower() for item in joint["joints"].keywords["items"][1:]]
    uses.add_argument("--pegs", choices=kinds, nargs="?", const="round", metavar="KIND",
                      help=f"join them for printing by {', '.join(kinds)} (default: round), closed")
    for option, name in (("count", "joint_count"), ("size", "joint_size"), ("depth", "joint_depth"),
                         ("clearance", "joint_clearance"), ("wall", "joint_wall")):
        words = joint[name].keywords
        uses.add_argument(f"--peg-{option}", dest=name, default=words["default"], metavar="N",
                          type=number(words["min"], words["max"]),
                          help=words["description"] + limits_of(words["min"], words["max"], words["default"]))


def _add_outputs(outputs: argparse._ArgumentGroup) -> None:
    for name, prop in (OutputProperties.__annotations__ | OverlayProperties.__annotations__).items():
        words = {"default": prop.keywords.get("default"), "help": prop.keywords["description"].replace("%", "%%")}
        if isinstance(words["default"], bool):
            words["action"] = argparse.BooleanOptionalAction
            words["help"] += f" (default: {'on' if words['default'] else 'off'})"
        elif "items" in prop.keywords:
            words |= _choice(prop.keywords["items"])
            words["help"] += " (default: " + prop.keywords["items"][0][1] + ")"
        else:
            low, high = prop.keywords["min"], prop.keywords["max"]
            words["help"] += limits_of(low, high, words["default"])
            words |= {"type": number(low, high), "metavar": "N"}
        outputs.add_argument(f"--{dashed(name)}", **words)


def _choice(items: list[tuple[str, str, str]]) -> dict[str, Any]:
    """How argparse takes one of the items of a property: by its label, or by its identifier, which scripts use."""
    known = {label: identifier for identifier, label, _ in items}

    def read(text: str) -> str:
        if text in known.values():
            return text
        if text not in known:
            raise argparse.ArgumentTypeError(f"must be one of {', '.join(known)}, not {text}")
        return known[text]

    return {"type": read, "metavar": f"{{{','.join(known)}}}", "default": items[0][0]}


def separate_style(options: argparse.Namespace) -> Any:
    """How parts become objects: the values of properties.SeparateProperties, by the options or their defaults."""
    style = argparse.Namespace(**{name: prop.keywords["default"] for name, prop in SEPARATE.items()})
    for name in JointProperties.__annotations__:
        setattr(style, name, getattr(options, name, getattr(style, name)))
    style.joint_count = round(style.joint_count)
    style.joints = (options.pegs or "none").upper()
    style.cut = (options.cuts or style.cut).upper()
    style.caps, style.cap_material = options.caps or options.cap_material, options.cap_material
    style.fit_bed, style.bed = bool(options.bed), options.bed or style.bed
    return style


def _size(text: str) -> tuple[int, int]:
    """Width and height out of "960x540"; argparse turns the error into a sentence."""
    width, _, height = text.partition("x")
    try:
        return int(PIXELS(width)), int(PIXELS(height))
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(
            f"must be two whole numbers from 16 to 8192 with an x between them, such as 960x540, not {text}") from error

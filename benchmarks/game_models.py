# SPDX-License-Identifier: GPL-3.0-or-later
"""Animals and people of the game 0 A.D. as labelled meshes: their parts are what their bones move.

    python3 benchmarks/game_models.py public.zip OUT

public.zip holds the game's data (alpha 26). OUT gets PACK.NAME.npz with ``vertices``, ``faces`` and ``human``, labels
from the bones that move each face most: coarse (head, torso, tail, arms, legs, wings), medium (upper and lower limbs,
neck, trunk) and fine (feet, ears). A pack is a skeleton. Some are dressed: pieces that the same skeleton moves lie over
them.
"""

from __future__ import annotations

import re
import struct
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from zipfile import ZipFile

import packages

packages.need("numpy", "scipy", "tqdm")

import numpy as np
from meshes import source_and_target, write_labelled
from skinned import N_BONES, Names, Skeleton, Skinned, labelled
from tqdm import tqdm

#: By skeleton, the models that it moves: in art/meshes/skeletal, without their endings.
MODELS = {
    "bovidae_skeleton": "auroch_a cattle_female_a cattle_female_b cattle_male_a sanga_cattle_a wildebeest_adult zebu",
    "elephantidae_asian": "elephant_african_baby elephant_african_bush elephant_asian_male elephant_asian_armored_01",
    "horse": "horse horse_breed", "horse_old": "animal_lion animal_lioness donkey", "hawk": "hawk seagull crow",
    "giraffe": "camel_1 giraffe_adult giraffe_infant", "boar": "animal_boar pig", "goat": "goat goat_male",
    "deer": "deer_mesh rabbit_01", "crocodile": "Croc", "tuna": "animal_tuna", "ursidae_armature": "bear",
    "camelus": "camel", "chicken": "chicken", "hippopotamus_armature": "fauna_hippopotamus", "fox_armature": "fox",
    "mastiff": "mastiff", "elephant_blender": "maur_elephant_archer", "peacock": "peacock", "rhino": "rhino",
    "shark": "shark", "sheep": "sheep", "feline_blender": "tiger", "whale": "whale_fin", "wolf": "wolf",
    "wolfhound": "wolfhound", "zebra": "zebra",
    "biped": "new/f_dress new/f_naked new/f_tunic_short new/m_armor_hero_tunic new/m_armor_pants new/m_dress_sleeves "
             "new/m_naked new/m_pants new/m_pants_loose_01 new/m_robe new/m_tunic_short new/m_hero_caros "
             "new/m_armor_tunic_long_med_sleeves new/m_armor_tunic_short_short_sleeves",
}
#: By skeleton, models with what they wear: of horses in art/meshes/props/horse, of people in props/new/capes.
DRESSED = {
    "horse": """horse_persian armor_pers_winged_01 hair_mane_01 hair_tail_01
                horse_celtic blanket_full_back hair_mane_02 hair_tail_01 rein_01
                horse_barb armor_kart blanket_short hair_tail_01
                horse_lusitano armor_iber hair_mane_01 hair_tail_01
                horse_tessalian armor_sele hair_tail_01 rein_01
                horse_breed blanket_long hair_mane_01_breed hair_tail_01_breed
                horse blanket_kush_full straps_kush hair_mane_02 hair_tail_01
                horse_marwari peytral_han blanket_pers hair_mane_01 hair_tail_01
                horse armor_front armor_back hair_tail_01""",
    "biped": """new/m_naked cape_hd_long
                new/m_pants m_cape_medium
                new/m_tunic_short cape_hd_hoplite
                new/f_dress f_cape_long
                new/m_armor_hero_tunic cape_hd_cav
                new/f_tunic_short f_cape_medium
                new/m_armor_tunic_long_sleeves cape_hd_ragged""",
}
WORN = {"horse": "props/horse/", "biped": "props/new/capes/"}
NO_BONE = 255  # in place of a bone
MOVES = 0.2  # weight from which on a bone is said to move anything


def read(archive: ZipFile, name: str) -> tuple[Skinned, int]:
    """One mesh in the game's own format, PMD 4, whose faces are stored inwards, and the number of its bones."""
    data = archive.read(f"art/meshes/{name}.dae.cached.pmd")
    if data[:4] != b"PSMD" or struct.unpack_from("<I", data, 4) != (4,):
        raise SystemExit(f"{name} is no PMD of version 4.")
    count, n_maps = struct.unpack_from("<II", data, 12)
    size = 24 + 8 * n_maps + 5 * N_BONES
    rows = np.frombuffer(data, np.uint8, count * size, 20).reshape(count, size)
    skin = 24 + 8 * n_maps
    vertices = rows[:, :12].copy().view("<f4").astype(float)
    bone, weight = rows[:, skin:skin + N_BONES].astype(int), rows[:, skin + N_BONES:].copy().view("<f4").astype(float)
    at = 20 + count * size
    (n_faces,) = struct.unpack_from("<I", data, at)
    faces = np.frombuffer(data, "<u2", 3 * n_faces, at + 4).reshape(n_faces, 3)[:, ::-1].astype(np.int64)
    (n_bones,) = struct.unpack_from("<I", data, at + 4 + 6 * n_faces)
    return Skinned(vertices, faces, np.where(bone == NO_BONE, 0, bone), weight), n_bones


def skeleton(archive: ZipFile, name: str, n_bones: int) -> Skeleton:
    """The skeleton of so many bones in a file of skeletons."""
    for root in ElementTree.fromstring(archive.read(f"art/skeletons/{name}.xml")).findall("standard_skeleton"):
        names, carrier = [], []
        open_ = [(bone, -1) for bone in root.findall("bone")][::-1]
        while open_:
            bone, above = open_.pop()
            open_ += [(below, len(names)) for below in bone.findall("bone")][::-1]
            names.append(bone.get("name"))
            carrier.append(above)
        if len(names) == n_bones:
            return Skeleton(names, carrier)
    raise SystemExit(f"{name} has no skeleton of {n_bones} bones.")


# What the names of bones say --------------------------------------------------------------------------

IS_LIMB = re.compile("leg|thigh|calf|shin|foot|toe|ankle|knee|hoof|femur|arm|hand|finger|paw|claw|elbow|"
                     "shoul?der|clavicle|hip_")
IS_NO_PART = re.compile(
    "target|pole|ik_|_ik|weapon|shield|ammo|sheath|quiver|cape|helmet|projectile|rein|armor|armature")
IS_FRONT = re.compile("front|shoul?der|clavicle|arm|hand|_f_|paw|claw|elbow")
IS_BACK = re.compile("back|(?<!fo)rear|thigh|femur|_r_|calf")
IS_ROOT = re.compile("shoul?der|clavicle|pelvis|hip_|legtop|femur|leg_?top_?$")  # of a limb; it moves the torso
IS_END = re.compile("foot|toe|hoof|hand|paw|claw|finger|tip")
FAMILY = re.compile("^(bovidae|ursidae|camelus|elephantidae|hippopotamidae|boar|tuna)_", re.I)
#: The coarse, the medium and the fine name of what is no limb, by the first pattern that a bone's name has.
OTHERS = [(re.compile(pattern), names) for pattern, *names in (
    ("tail", "tail", "tail", "tail"), ("wingtip|digit", "wing{s}", "wing{s}", "wing tip{s}"),
    ("wing|humerus|ulna", "wing{s}", "wing{s}", "wing{s}"), ("fin(?!ger)", "{name}", "{name}", "{name}"),
    ("trunk", "head", "trunk", "trunk"), ("(^|_)ear", "head", "head", "ear{s}"),
    ("head|jaw|tongue|maxila|mohawk", "head", "head", "head"), ("neck|cervical", "head", "neck", "neck"))]


def side(name: str) -> str:
    """.L or .R of a bone on one side, else nothing."""
    for letter, word in (("L", "left"), ("R", "right")):
        if re.search(rf"(^|[_.]){letter}([_.]|$)|(Front|Back){letter}(?=[A-Z])", name) or re.search(
                rf"(^|_){letter.lower()}(_|$)|{word}", name if word not in name.lower() else name.lower()):
            return f".{letter}"
    return ""


def parts_of_bones(bones: Skeleton, moves: np.ndarray) -> list[Names]:
    """Coarse, medium and fine name of what each bone moves. moves : (b,) bool, bones that move anything."""
    low = [FAMILY.sub("", name).lower() for name in bones.names]
    named: list[Names] = [("torso",) * 3] * len(low)
    limbs: dict[tuple[str, str], list[int]] = {}
    for number, name in enumerate(low):
        above = bones.carrier[number]
        of = side(bones.names[number]) or (side(bones.names[above]) if above >= 0 else "")
        other = next((names for pattern, names in OTHERS if pattern.search(name)), None)
        if IS_NO_PART.search(name):
            continue
        if other and not (name.startswith("foot") and "tip" in name):
            named[number] = tuple(text.format(s=of, name=name) for text in other)
        elif IS_LIMB.search(name):
            limbs.setdefault((_end_of_body(number, low, bones), of), []).append(number)
    biped = {"hip", "chest"} <= set(low)
    for (end, of), numbers in limbs.items():
        limb = {"front": "arm", "back": "leg"}[end] if biped else f"{end} leg"
        for number, parts in _along_limb([n for n in numbers if moves[n]], low, limb, of).items():
            named[number] = parts
    return named


def _end_of_body(number: int, low: list[str], bones: Skeleton) -> str:
    """Whether the limb of a bone is at the front or at the back, by its name and those of what carries it."""
    chain = []
    while number >= 0:
        if IS_LIMB.search(low[number]) or "pelvis" in low[number]:
            chain.append(low[number])
        number = bones.carrier[number]
    back = any(IS_BACK.search(name) and not re.search("front|_f_", name) for name in chain)
    return "front" if any(map(IS_FRONT.search, chain)) and not back else "back"


def _along_limb(numbers: list[int], low: list[str], limb: str, of: str) -> dict[int, Names]:
    """Names of what the bones of one limb move, from the body on: first halves are upper, second halves lower ones."""
    inner = [n for n in numbers if not IS_ROOT.search(low[n])] or numbers
    ends = [n for n in inner if IS_END.search(low[n])]
    middle = [n for n in inner if n not in ends]
    named = {n: (f"{limb}{of}", f"lower {limb}{of}", f"foot {limb}{of}") for n in ends}
    for place, n in enumerate(middle):
        half = "upper" if place < (len(middle) + 1) // 2 else "lower"
        named[n] = f"{limb}{of}", f"{half} {limb}{of}", f"{half} {limb}{of}"
    return named


def main() -> None:
    source, out = source_and_target(__doc__, "public.zip")
    tasks = [(pack, name, [name]) for pack, names in MODELS.items() for name in names.split()]
    for pack, sets in DRESSED.items():
        for number, line in enumerate(sets.splitlines()):
            name, *worn = line.split()
            tasks.append((pack, f"{name}_dressed_{number}", [name, *(WORN[pack] + other for other in worn)]))
    with ZipFile(source) as archive:
        for pack, name, (body, *worn) in tqdm(tasks):
            naked, n_bones = read(archive, f"skeletal/{body}")
            bones = skeleton(archive, pack, n_bones)
            moves = np.zeros(n_bones, bool)
            moves[np.unique(naked.bone[naked.weight > MOVES])] = True
            pieces = [naked, *(read(archive, file)[0] for file in worn)]
            model = labelled(pieces, parts_of_bones(bones, moves))
            write_labelled(out / f"game_{pack}.{Path(name).name}.npz", **model)


if __name__ == "__main__":
    main()

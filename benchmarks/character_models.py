# SPDX-License-Identifier: GPL-3.0-or-later
"""Characters of two games as labelled meshes: their parts are what their bones move.

    python3 benchmarks/character_models.py SOURCE OUT

SOURCE is the folder of data of SuperTuxKart 1.4 - mascots and people in its own format, SPM 1, drivers without their
karts - or Nexuiz's data.pk3 (2.5.2) - fighters of one piece to thirty-one in the format Zymotic. OUT gets PACK.NAME.npz
with ``vertices``, ``faces`` and ``human``, labels coarse (head, torso, tail, arms, legs, wings), medium (upper and
lower limbs, neck) and fine (hands, feet, ears, hair). A pack is a character, or the fighters.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from pathlib import Path
from zipfile import ZipFile

import packages

packages.need("numpy", "tqdm")

import numpy as np
from meshes import source_and_target, stacked, write_labelled
from skinned import N_BONES, Names, Skeleton, Skinned, labelled
from tqdm import tqdm

#: By pack, the models of SuperTuxKart: their paths in its data, without .spm.
KARTS = {
    "adiumy": "karts/adiumy/adiumy", "amanda": "karts/amanda/amanda",
    "aztek": "library/stklib_aztekGirlCheering_a/stklib_aztekGirlCheering_a_main",
    "beach_guy": "library/stklib_beachGuy_a/stklib_beachGuy_a_main",
    "beach_woman": "library/stklib_beachWomen_a/stklib_beachWomen_a_main",
    "chest": "models/chest", "emule": "karts/emule/emule", "gavroche": "karts/gavroche/gavroche",
    "gnu": "karts/gnu/gnu library/stklib_gnuMeditation_a/stklib_gnuMeditation_a_main tracks/introcutscene/Gnu_intro",
    "kiki": "karts/kiki/kiki library/stklib_kiki_a/stklib_kiki_a_main",
    "konqi": "karts/konqi/konqi library/stklib_konqi_a/stklib_konqi_a_main",
    "monkey": "library/stklib_monkeyCheering_a/stklib_monkeyCheering_a_main",
    "nolok": "karts/nolok/nolok tracks/introcutscene2/Nolok_intro models/swatter_nolok",
    "pidgin": "karts/pidgin/pidgin",
    "sara": "karts/sara_the_wizard/sara karts/sara_the_racer/pepper tracks/ancient_colosseum_labyrinth/Sara",
    "silvian": "library/stklib_silvianGirl_a/stklib_silvianGirl_a_main",
    "suzanne": "karts/suzanne/suzanne", "thunderbird": "models/thunderbird",
    "tux": "karts/tux/tux tracks/endcutscene/EndingTux tracks/introcutscene2/TuxIntro",
    "wilber": "karts/wilber/wilber",
    "wilbert": "library/stklib_wilbertSecurity_a/stklib_wilbertSecurity_a_main", "xue": "karts/xue/xue",
}
FIGHTERS = "models/player/"  # in Nexuiz's data; files with _lod in their names are coarser copies
WHITE = 128  # in place of a vertex's color: there is none


# Reading ----------------------------------------------------------------------------------------------


class Bytes:
    """What a file holds, read from its beginning on."""

    def __init__(self, data: bytes) -> None:
        self.data, self.at = data, 0

    def take(self, layout: str) -> tuple:
        """Numbers of a layout of ``struct``, little end first."""
        values = struct.unpack_from("<" + layout, self.data, self.at)
        self.at += struct.calcsize("<" + layout)
        return values

    def text(self) -> str:
        """Text after its length."""
        (length,) = self.take("B")
        return self.take(f"{length}s")[0].decode()

    def array(self, kind: str, count: int) -> np.ndarray:
        """So many numbers of a type of NumPy's, little end first."""
        values = np.frombuffer(self.data, np.dtype(kind).newbyteorder("<"), count, self.at)
        self.at += values.nbytes
        return values


def read_spm(data: bytes) -> tuple[Skinned, Skeleton]:
    """A model that bones move, in SuperTuxKart's format: one bone more than it has moves what none of them does."""
    file = Bytes(data)
    mark, kind, has = file.take("2sBB")
    if (mark, kind) != (b"SP", 9):
        raise SystemExit("This is no model with bones in the format SPM 1.")
    file.take("6f")
    textures = [(file.text(), file.text()) for _ in range(file.take("H")[0])]
    buffers = [_spm_buffer(file, has, textures) for _ in range(file.take("H")[0]) for _ in range(file.take("H")[0])]
    vertices, faces, bone, weight = zip(*buffers, strict=True)
    names, carrier, number = [], [], []  # number : of the bones that vertices name
    for _ in range(file.take("BH")[0]):  # armatures
        in_use, count = file.take("HH")
        number += range(len(names), len(names) + in_use)
        first = len(names)
        names += [file.text() for _ in range(count)]
        file.take(f"{10 * count}f")
        carrier += [above + first if above >= 0 else -1 for above in file.take(f"{count}h")]
        file.take(f"{file.take('H')[0] * (2 + 40 * count)}s")  # the frames of its animation
    bone, weight = np.concatenate(bone), np.concatenate(weight).astype(float)
    free = (bone < 0) | (weight <= 0)
    weight[free.all(axis=1), 0] = 1
    bone = np.where(free, len(names), np.array(number)[np.where(free, 0, bone)])
    vertices, faces, _ = stacked(vertices, faces)
    return Skinned(vertices, faces, bone, weight), Skeleton([*names, "still"], [*carrier, -1])


def _spm_buffer(file: Bytes, has: int, textures: list[tuple[str, str]]) -> tuple[np.ndarray, ...]:
    """Vertices, faces, bones and weights of what one material covers. has : bits for normals, colors and tangents."""
    count, n_corners, material = file.take("IIH")
    one, two = map(bool, textures[material])
    after = one * (4 + 4 * two + (has & 4))  # bytes of texture coordinates and tangents
    start = []
    for _ in range(count):
        start.append(file.at)
        file.at += 12 + 4 * (has & 1)
        if has & 2:
            file.at += 1 if file.data[file.at] == WHITE else 4
        file.at += after + 4 * N_BONES
    start, data = np.array(start), np.frombuffer(file.data, np.uint8)
    end = np.append(start[1:], file.at)
    vertices = data[start[:, None] + np.arange(12)].view("<f4").astype(float)
    moved = data[end[:, None] + np.arange(-4 * N_BONES, 0)]
    faces = file.array("u2" if count > 255 else "u1", n_corners).reshape(-1, 3)[:, ::-1].astype(np.int64)
    return vertices, faces, moved[:, :8].copy().view("<i2").astype(int), moved[:, 8:].copy().view("<f2")


def read_zym(data: bytes) -> tuple[Skinned, Skeleton]:
    """A model in the format Zymotic, whose numbers have the big end first and whose vertices have one bone each."""
    if data[:12] != b"ZYMOTICMODEL":
        raise SystemExit("This is no model in the format Zymotic.")
    n_vertices, _, _, n_bones, _ = struct.unpack_from(">5i", data, 48)
    start, length = np.frombuffer(data, ">i4", 18, 68).reshape(9, 2).T
    bones = [struct.unpack_from(">32s2i", data, start[2] + 40 * k) for k in range(n_bones)]
    skeleton = Skeleton([name.split(b"\0")[0].decode("latin1") for name, _, _ in bones], [c for _, _, c in bones])
    pose = np.tile(np.eye(4), (n_bones, 1, 1))
    pose[:, :3] = np.frombuffer(data, ">f4", 12 * n_bones, start[1]).reshape(-1, 3, 4)
    for number, above in enumerate(skeleton.carrier):  # a bone comes after the one that carries it
        if above >= 0:
            pose[number] = pose[above] @ pose[number]
    rows = np.frombuffer(data, np.uint8, 16 * n_vertices, start[4]).reshape(-1, 16)
    bone, place = rows[:, :4].copy().view(">i4")[:, 0].astype(int), rows[:, 4:].copy().view(">f4").astype(float)
    vertices = np.einsum("nij,nj->ni", pose[bone, :3, :3], place) + pose[bone, :3, 3]
    runs, faces, at = np.frombuffer(data, ">i4", length[6] // 4, start[6]).astype(np.int64), [], 0
    while at < len(runs):  # of each material the number of its faces, then their corners
        faces.append(runs[at + 1:at + 1 + 3 * runs[at]].reshape(-1, 3))
        at += 1 + 3 * runs[at]
    weight = np.tile([1.0] + [0.0] * (N_BONES - 1), (n_vertices, 1))
    return Skinned(vertices, np.concatenate(faces), np.repeat(bone[:, None], N_BONES, axis=1), weight), skeleton


# What the names of bones say --------------------------------------------------------------------------

#: Coarse, medium and fine names by the first pattern that the name of a bone has; .. stands for its side.
PARTS = [(re.compile(pattern), tuple(names.split(", "))) for pattern, names in (
    ("kart|^car$|^main$|^hc[.]|steer|volant|tapis|tail_light|scream|still", "still, still, still"),
    ("tablet|pen$|flute|gun|bull|lamp|^rod|swatter|bucket|banana|handle|mainbody|ammo|handrest|key|lid|bodyall",
     "{name}, {name}, {name}"),
    ("scarf|cravate|cape", "torso, scarf, scarf"), ("skirt", "torso, torso, skirt"),
    ("hair|^hat", "head, head, hair"),
    ("eye|brow|jaw|mouth|lip|beak|levre|machoire|museau|tongue|glasses|moustache|oeil|^band", "head, head, head"),
    ("forearm|lower_?arm|arm_lower|arm[23]|arm_1|bras-1|bras-[lr][.]001", "arm.., lower arm.., lower arm.."),
    ("(right|left)palm", "leg.., lower leg.., foot.."),
    ("hand|finger|thumb|index|^ring|paw|pouce", "arm.., lower arm.., hand.."),
    ("wing.*(00[12]|[23])", "wing.., wing.., wing tip.."), ("wing", "wing.., wing.., wing.."),
    ("frontleg.upper", "front leg.., upper front leg.., upper front leg.."),
    ("frontleg", "front leg.., lower front leg.., lower front leg.."),
    ("ear([._]|$)|oreille", "head, head, ear.."), ("crest", "head, head, crest"),
    ("neck", "head, neck, neck"), ("head", "head, head, head"), ("tail|queue", "tail, tail, tail"),
    ("shoulder|clavicle", "torso, torso, torso"), ("arm|bras", "arm.., upper arm.., upper arm.."),
    ("shin|calf|leg.lower|lowerleg|leg_1|jambe-.[.]001|leg[1-4]|horselink", "leg.., lower leg.., lower leg.."),
    ("foot|feet|toe|pied", "leg.., lower leg.., foot.."), ("thigh|jambe|leg", "leg.., upper leg.., upper leg.."),
    ("spine|pelvis|hip|chest|torso|body|corps|coxis|trunk|root|gnu", "torso, torso, torso"))]
PREFIX = re.compile("^(def-|bip01 |bone[.](?=[a-z]))")
SIDES = [(re.compile(rf"[._ -]\d?{letter}([._ ]|$|\d)|{word}"), f".{letter.upper()}")
         for letter, word in (("l", "left"), ("r", "right"))]


def parts_of_bones(bones: Skeleton) -> list[Names]:
    """The names of what each bone moves: those of what carries it where its own name says nothing."""
    named: dict[int, Names] = {-1: ("torso",) * 3}

    def names(number: int) -> Names:
        if number not in named:
            low = bones.names[number].lower()
            side = next((mark for pattern, mark in SIDES if pattern.search(low)), "")
            low = PREFIX.sub("", low)
            found = next((parts for pattern, parts in PARTS if pattern.search(low)), None)
            named[number] = (tuple(part.replace("..", side).format(name=low) for part in found) if found
                             else names(bones.carrier[number]))
        return named[number]

    return [names(number) for number in range(len(bones.names))]


def models(source: Path) -> Iterator[tuple[str, Skinned, Skeleton]]:
    """Name, mesh and skeleton of each character."""
    if source.is_dir():
        for pack, paths in KARTS.items():
            for path in paths.split():
                name = Path(path).name.removeprefix("stklib_").removesuffix("_a_main")
                driver = "_driver" if path.startswith("karts/") else ""
                yield f"kart_{pack}.{name}{driver}", *read_spm((source / f"{path}.spm").read_bytes())
    else:
        with ZipFile(source) as archive:
            for path in sorted(archive.namelist()):
                if path.startswith(FIGHTERS) and path.endswith(".zym") and "_lod" not in path:
                    yield f"fighter.{Path(path).stem}", *read_zym(archive.read(path))


def main() -> None:
    source, out = source_and_target(__doc__, "SOURCE")
    for name, mesh, bones in tqdm(models(source)):
        write_labelled(out / f"{name}.npz", **labelled([mesh], parts_of_bones(bones), without={"still"}))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Another mesh in place of the one of a piece, as if that itself had changed."""

from __future__ import annotations

import bpy

from .. import targets, transaction


def replace(piece: bpy.types.Object, mesh: bpy.types.Mesh) -> None:
    """Have a new mesh in place of the one of a piece, for whatever refers to that, and under its name.

    A mesh that other objects share, or that is of a library, stays as it is, and only the piece has the new one.
    """
    old = piece.data
    transaction.keep(piece, "data")
    piece.data = mesh
    if old.library is not None or targets.users(old):
        return
    mesh.use_fake_user = old.use_fake_user
    names = [(new, former.name) for new, former in ((mesh, old), (mesh.shape_keys, old.shape_keys)) if former]
    transaction.at_end(old.user_remap, mesh)
    transaction.discard(old)
    for new, name in names:
        new.name = name

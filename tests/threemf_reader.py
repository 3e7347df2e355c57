# SPDX-License-Identifier: GPL-3.0-or-later
"""A reader of 3MF files that holds them to the rules of the core specification, and to no more than the parts it needs.

Rules: the content types and the relationship of the package; one model with resources and build in this order; elements
in the namespace of the core and with the attributes that it knows; numbers, colors and transforms in its notation;
identifiers that are unique and defined before they are used; triangles of three different vertices that are there.
"""

import re
import xml.etree.ElementTree as ElementTree
import zipfile
from dataclasses import dataclass

import numpy as np

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
TYPES = "{http://schemas.openxmlformats.org/package/2006/content-types}"
RELATIONS = "{http://schemas.openxmlformats.org/package/2006/relationships}"
NUMBER = r"[-+]?(([0-9]+(\.[0-9]+)?)|(\.[0-9]+))([eE][-+]?[0-9]+)?"
#: The attributes that each element may have, with what they look like.
ATTRIBUTES = {
    "model": {"unit": "micron|millimeter|centimeter|inch|foot|meter",
              "{http://www.w3.org/XML/1998/namespace}lang": r"[a-zA-Z-]+"},
    "metadata": {"name": "Title|Designer|Description|Copyright|LicenseTerms|Rating|CreationDate|Application"},
    "resources": {}, "build": {}, "mesh": {}, "vertices": {}, "triangles": {}, "components": {},
    "basematerials": {"id": r"[1-9][0-9]*"}, "base": {"name": r"(?s).*", "displaycolor": "#[0-9A-F]{6}([0-9A-F]{2})?"},
    "object": {"id": r"[1-9][0-9]*", "type": "model|solidsupport|support|surface|other", "pid": r"[1-9][0-9]*",
               "pindex": "[0-9]+", "name": r"(?s).*"},
    "vertex": dict.fromkeys("xyz", NUMBER), "triangle": dict.fromkeys(("v1", "v2", "v3"), "[0-9]+"),
    "component": {"objectid": r"[1-9][0-9]*"}, "item": {"objectid": r"[1-9][0-9]*",
                                                        "transform": f"{NUMBER}( {NUMBER}){{11}}"},
}


@dataclass
class Body:
    """An object with a mesh: its name, the color of its material, vertices (n, 3) and triangles (m, 3)."""

    name: str
    color: str
    vertices: np.ndarray
    triangles: np.ndarray


def read_3mf(path):
    """The bodies of a file, and where its assemblies are moved to, (k, 3); an AssertionError for a broken rule."""
    with zipfile.ZipFile(path) as package:
        assert package.testzip() is None
        kinds = {entry.get("Extension"): entry.get("ContentType")
                 for entry in ElementTree.fromstring(package.read("[Content_Types].xml")).iter(f"{TYPES}Default")}
        assert kinds == {"rels": "application/vnd.openxmlformats-package.relationships+xml",
                         "model": "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"}
        (relation,) = ElementTree.fromstring(package.read("_rels/.rels")).iter(f"{RELATIONS}Relationship")
        assert relation.get("Type") == "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
        model = ElementTree.fromstring(package.read(relation.get("Target").lstrip("/")))
    for element in model.iter():
        known = ATTRIBUTES[element.tag.removeprefix(CORE)]
        for name, value in element.attrib.items():
            assert re.fullmatch(known[name], value), (element.tag, name, value)
    assert model.tag == f"{CORE}model"
    assert model.get("unit") == "millimeter"
    assert [child.tag for child in model if child.tag != f"{CORE}metadata"] == [f"{CORE}resources", f"{CORE}build"]
    materials, bodies, assemblies = {}, {}, {}
    for resource in model.find(f"{CORE}resources"):
        number = resource.get("id")
        assert number not in {**materials, **bodies, **assemblies}
        if resource.tag == f"{CORE}basematerials":
            assert len(resource)
            materials[number] = [base.get("displaycolor") for base in resource]
            continue
        (content,) = resource
        if content.tag == f"{CORE}mesh":
            bodies[number] = _body(resource, content, materials)
        else:
            assemblies[number] = [component.get("objectid") for component in content]
            assert assemblies[number]
            assert set(assemblies[number]) <= set(bodies)
    items = model.findall(f"{CORE}build/{CORE}item")
    assert [item.get("objectid") for item in items] == list(assemblies)
    assert sorted(part for parts in assemblies.values() for part in parts) == sorted(bodies)
    return list(bodies.values()), np.array([item.get("transform").split()[9:] for item in items], float)


def _body(resource, mesh, materials):
    vertices, triangles = mesh
    points = np.array([[vertex.get(axis) for axis in "xyz"] for vertex in vertices], float)
    corners = np.array([[triangle.get(corner) for corner in ("v1", "v2", "v3")] for triangle in triangles], int)
    assert len(points) >= 3
    assert len(corners)
    assert corners.max() < len(points)
    assert (np.sort(corners)[:, 1:] != np.sort(corners)[:, :-1]).all()
    return Body(resource.get("name"), materials[resource.get("pid")][int(resource.get("pindex"))], points, corners)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Where joints go: the deepest place of a cut, as large as fits, with a wall all around that is measured."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
import shapes

from core import decompose
from core.uses.joints.cap import Cap, arc_direction
from core.uses.joints.places import joint_places
from core.uses.joints.room import Wanted
from core.uses.joints.shapes import Kind

WANTED = Wanted(Kind.ROUND, 1, clearance=0.01, size=0.0, depth=0.0, wall=0.05, least=0.02)


@dataclass(frozen=True)
class Box:
    """The inside of a box without some of its ends, or what is outside of another one in it."""

    low: tuple
    high: tuple
    void: "Box | None" = None
    open: int = 0  # -1 or 1: the end along z that is the cap

    def distance(self, points):
        below, above = points - np.array(self.low), np.array(self.high) - points
        if self.open < 0:
            below = np.where([False, False, True], np.inf, below)
        elif self.open > 0:
            above = np.where([False, False, True], np.inf, above)
        inner = np.abs(np.concatenate([below, above], axis=1)).min(axis=1)
        return inner if self.void is None else np.minimum(inner, self.void.distance_outside(points))

    def distance_outside(self, points):
        inner = np.minimum(points - np.array(self.low), np.array(self.high) - points)
        outer = np.linalg.norm(np.maximum(-inner, 0), axis=1)
        return np.where(outer > 0, outer, inner.min(axis=1))

    def inside(self, points):
        here = ((points > np.array(self.low)) & (points < np.array(self.high))).all(axis=1)
        return here if self.void is None else here & ~self.void.inside(points)


def cap(width=2.0, depth=2.0, n=8):
    """A rectangle at z = 0 that looks up."""
    x, y = np.meshgrid(np.linspace(-width / 2, width / 2, n + 1), np.linspace(-depth / 2, depth / 2, n + 1),
                       indexing="ij")
    quads = shapes.grid_quads(n, n, n + 1)
    points = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    triangles = shapes.split_quads(quads)
    a, b, c = points[triangles[0]]
    return with_rims(points, triangles if np.cross(b - a, c - a)[2] > 0 else triangles[:, ::-1])


def with_rims(points, triangles):
    """A cap with the edges around it."""
    edges, count = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0,
                             return_counts=True)
    return Cap(points, triangles, points[edges[count == 1]])


def bodies(width=2.0, depth=2.0, below=3.0, above=3.0, void=None):
    x, y = width / 2, depth / 2
    return (Box((-x, -y, -below), (x, y, 0.0), void, open=1), Box((-x, -y, 0.0), (x, y, above), void, open=-1))


def test_a_peg_in_the_middle_a_third_as_wide():
    found = joint_places(cap(), bodies(), WANTED)
    (joint,) = found.joints
    assert found.width == pytest.approx(2.0, rel=2e-3)
    assert joint.radius == pytest.approx(1 / 3, rel=2e-3)
    assert joint.origin == pytest.approx([0, 0, 0], abs=1e-9)
    assert joint.axes[2] == pytest.approx([0, 0, 1])
    assert np.linalg.det(joint.axes) == pytest.approx(1)
    assert (joint.low, joint.high) == pytest.approx((0, 0), abs=1e-9)
    assert joint.depth == pytest.approx(2.5 / 3, rel=2e-3)


@pytest.mark.parametrize("into", [0, 1])
def test_the_piece_that_should_receive_the_joint_does(into):
    (joint,) = joint_places(cap(), bodies(), WANTED, into).joints
    assert joint.axes[2] == pytest.approx([0, 0, 1 if into else -1])


def test_the_other_piece_does_where_one_is_too_thin():
    found = joint_places(cap(), bodies(above=0.1), WANTED, 1)
    assert found.into == 0
    assert found.joints


@pytest.mark.parametrize("above", [0.4, 0.6, 0.8])
def test_the_end_of_a_peg_keeps_the_wall(above):
    """Where both pieces are short, the joint gets shorter and smaller."""
    (joint,) = joint_places(cap(), bodies(below=above, above=above), WANTED).joints
    wall = max(WANTED.wall, joint.radius / 3)
    assert joint.depth + WANTED.clearance + wall <= above + 1e-9


def test_none_where_there_is_no_room():
    assert not joint_places(cap(), bodies(below=0.1, above=0.1), WANTED).joints
    assert not joint_places(cap(0.12, 0.12), bodies(0.12, 0.12), WANTED).joints
    assert not joint_places(cap(), bodies(), replace(WANTED, wall=0.95)).joints
    assert not joint_places(cap(), bodies(), replace(WANTED, least=0.7)).joints


@pytest.mark.parametrize("thickness", [0.1, 0.3, 0.6])
def test_a_shell_takes_what_fits_in_its_wall(thickness):
    """The void of a tube is no room, however wide it is."""
    inner = 1.0 - thickness
    void = Box((-inner, -inner, -9.0), (inner, inner, 9.0))
    found = joint_places(cap(), bodies(void=void), WANTED)
    assert bool(found.joints) == (thickness > 0.15)
    for joint in found.joints:
        x, y, _ = np.abs(joint.origin)
        assert max(x, y) - joint.radius - WANTED.clearance - WANTED.wall >= inner - 1e-9
        assert max(x, y) + joint.radius + WANTED.clearance + WANTED.wall <= 1.0 + 1e-9


@pytest.mark.parametrize("count", [1, 2, 3])
def test_several_joints_keep_apart(count):
    found = joint_places(cap(6.0, 2.0), bodies(6.0, 2.0), replace(WANTED, count=count))
    assert len(found.joints) == count
    places = np.array([joint.origin for joint in found.joints])
    for i in range(count):
        for j in range(i):
            assert np.linalg.norm(places[i] - places[j]) > 1.0
    assert (1.0 - np.abs(places[:, 1]) >= 0.6).all()


def test_fewer_where_there_is_room_for_one_only():
    """A post with three pegs of a given width has room for one."""
    wanted = replace(WANTED, count=3, size=1.2, least=1.1)
    assert len(joint_places(cap(), bodies(), wanted).joints) == 1


@pytest.mark.parametrize("kind", [Kind.DOWEL, Kind.MAGNET])
def test_holes_on_both_sides_go_as_deep(kind):
    (joint,) = joint_places(cap(), bodies(below=0.7), replace(WANTED, kind=kind)).joints
    assert joint.foot == joint.depth
    assert joint.depth + WANTED.clearance + max(WANTED.wall, joint.radius / 3) <= 0.7 + 1e-9


def test_given_width_and_depth():
    (joint,) = joint_places(cap(), bodies(), replace(WANTED, size=0.5, depth=1.0)).joints
    assert joint.radius == 0.25
    assert joint.depth == pytest.approx(1.0)


@pytest.mark.parametrize("seed", range(3))
def test_places_turn_and_grow_with_the_pieces(seed):
    rng = np.random.default_rng(seed)
    turn, scale, move = shapes.rotation(rng), 10.0 ** rng.uniform(-3, 3), rng.normal(size=3)

    class Moved:
        def __init__(self, body):
            self.body = body

        def distance(self, points):
            return scale * self.body.distance((points - move) @ turn / scale)

        def inside(self, points):
            return self.body.inside((points - move) @ turn / scale)

    # A shape with no mirror plane, so that there is one deepest place.
    plain = cap(3.0, 1.0)
    void = Box((-1.5, -0.5, -9), (-1.2, 0.3, 9))
    pair = bodies(3.0, 1.0, void=void)
    first = joint_places(plain, pair, replace(WANTED, wall=0.03, count=2))
    moved = with_rims(scale * plain.points @ turn.T + move, plain.triangles[rng.permutation(len(plain.triangles))])
    wanted = replace(WANTED, clearance=scale * WANTED.clearance, wall=scale * 0.03, least=scale * WANTED.least, count=2)
    second = joint_places(moved, (Moved(pair[0]), Moved(pair[1])), wanted)
    assert len(second.joints) == len(first.joints) == 2
    assert second.width == pytest.approx(scale * first.width, rel=1e-2)
    for one in second.joints:
        assert one.axes[2] == pytest.approx(turn @ [0, 0, 1], abs=1e-6)
        assert one.radius == pytest.approx(scale * first.joints[0].radius, rel=1e-2)
    gap = [np.linalg.norm(found.joints[0].origin - found.joints[1].origin) for found in (first, second)]
    # Places are tried on a grid.
    assert gap[1] / scale == pytest.approx(gap[0], abs=3 * np.sqrt(3.0 / 400))


def test_a_bent_cap_has_an_axis_only_if_told():
    """Most of a sphere looks nowhere; the body around it is large."""
    points, triangles = shapes.icosphere(3)
    kept = points[triangles].mean(axis=1)[:, 2] > -0.6
    bowl = with_rims(points, triangles[kept])
    pair = (Box((-9, -9, -9), (9, 9, 9)), Box((-9, -9, -9), (9, 9, 9)))
    assert joint_places(bowl, pair, WANTED).bent
    found = joint_places(bowl, pair, WANTED, along=np.array([0.0, 0.0, 2.0]))
    assert not found.bent


@pytest.mark.parametrize("corners", [[(-1, 0), (2, 0), (0, 1)], [(0, 0), (1, 0), (0.5, np.sqrt(0.75))],
                                     [(0, 0), (9, 0), (0, 1)]])
@pytest.mark.parametrize("seed", range(3))
@np.errstate(all="raise")
def test_a_cap_of_one_triangle_has_an_axis(corners, seed):
    """The middle of its only triangle is its own middle: from where the triangles are, nothing can be told."""
    rng = np.random.default_rng(seed)
    turn, offset = (np.linalg.qr(rng.normal(size=(3, 3)))[0], rng.normal(size=3)) if seed else (np.eye(3), 0)
    points = np.column_stack([corners, np.zeros(3)]) @ turn.T + offset
    one = with_rims(points, np.array([[0, 1, 2]]))
    pair = (Box((-99,) * 3, (99,) * 3), Box((-99,) * 3, (99,) * 3))
    found = joint_places(one, pair, WANTED)
    (joint,) = found.joints
    assert joint.axes @ joint.axes.T == pytest.approx(np.eye(3), abs=1e-9)
    assert np.abs(joint.axes[2] @ np.cross(points[1] - points[0], points[2] - points[0])) == pytest.approx(
        2 * one.area())
    a, b, c = (np.linalg.norm(points[i] - points[j]) for i, j in ((1, 2), (2, 0), (0, 1)))
    assert found.width == pytest.approx(2 * 2 * one.area() / (a + b + c), rel=0.02)  # of the inscribed circle


def test_the_arc_beside_a_cut_gives_its_direction():
    graph = decompose(*shapes.dumbbell()).graph
    found = arc_direction(graph, np.array([0.1, 0.0, 0.3]))
    # The ends of the arc are corners of the mesh, beside the axis.
    assert np.abs(found / np.linalg.norm(found)) == pytest.approx([0, 0, 1], abs=0.1)


def test_a_bowed_cap_is_passed_over_its_whole_height():
    """Over a dome, a peg reaches as far beyond the highest place under it, and its foot stands below the lowest."""
    flat = cap(2.0, 2.0, 24)
    radius = np.linalg.norm(flat.points[:, :2], axis=1)
    dome = with_rims(np.column_stack([flat.points[:, :2], 0.2 * (1 - radius**2)]), flat.triangles)
    pair = (Box((-1, -1, -3), (1, 1, 1), open=1), Box((-1, -1, -1), (1, 1, 3), open=-1))
    (joint,) = joint_places(dome, pair, WANTED).joints
    reach = joint.radius + WANTED.clearance
    seen = (dome.points - joint.origin) @ joint.axes.T
    under = seen[np.linalg.norm(seen[:, :2], axis=1) <= reach, 2]
    assert joint.high >= under.max() - 1e-3
    assert joint.low <= under.min() + 1e-3
    assert joint.high - joint.low == pytest.approx(0.2 * reach**2, rel=0.2)


@pytest.mark.parametrize(("height", "count"), [(1.115, 1), (1.105, 0)])
def test_a_hole_is_deeper_than_its_peg_by_the_clearance(height, count):
    """A peg 1 long, a clearance of 0.01 and a wall of 0.1 need 1.11."""
    wanted = replace(WANTED, size=0.5, depth=1.0, wall=0.1)
    assert len(joint_places(cap(), bodies(below=height, above=height), wanted).joints) == count


@pytest.mark.parametrize(("width", "count"), [(2.15, 1), (3.0, 2)])
def test_between_two_pegs_is_a_wall_too(width, count):
    """Two pegs 0.5 wide with a clearance of 0.01, and three walls of 0.4, need 2.24."""
    wanted = replace(WANTED, size=0.5, count=2, wall=0.4, least=0.49)
    assert len(joint_places(cap(width, 1.5, 24), bodies(width, 1.5), wanted).joints) == count

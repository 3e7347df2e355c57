# SPDX-License-Identifier: GPL-3.0-or-later
"""Where cuts meet: the middle that all caps around there go to, and the ways to it, which stay inside the model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from operator import itemgetter
from typing import TYPE_CHECKING

import numpy as np

from ....core.arrays.components import components
from ....core.arrays.indexing import renumbered, sums_by
from ....core.arrays.int64 import arange, cumsum
from ....core.arrays.ties import rounded
from ....core.arrays.vectors import box_diagonal, distances_between, lengths
from ....core.uses.caps.networks import nested_sides, own_places
from ....core.uses.caps.surfaces import common_order
from .body_surface import crossing, search_tree
from .discs import LED_IN, PLAIN

if TYPE_CHECKING:
    from .body_surface import BodySurface
    from .discs import Discs

# The body around places is that in their bounding box, wider by such a share of its diagonal.
_WIDER = 0.1
# More faults than caps can have.
_ENDLESS = 1 << 30
# A way that is nearer to the surface than such a share of the distance from its ends is bent; so often it is pushed
# off, to such a share.
_NEAR, _ROUNDS, _AWAY = 0.1, 10, 0.3
# A middle whose plain caps cross so many times as often as those of another is not tried any further.
_HOPELESS = 2
# So many middles are tried, those that are seen from the same places no nearer to each other than such a share of the
# size of all.
_MIDDLES, _APART = 12, 0.1
# After so many middles, no more are tried where these have taken so many caps: of ragged networks, which nothing helps.
_FIRST, _CAPS = 4, 400
# For each of several middles, so many places are tried besides the means of the others.
_OPTIONS = 6
# A way has at most so many points; for a straight one it is asked at so many whether it is inside.
_MOST, _TRIED = 16, 8


def ways_to_middles(points: np.ndarray, cuts: np.ndarray, meeting: np.ndarray, discs: Discs) -> dict[int, np.ndarray]:
    """Find how caps go on from the places where more than two cuts meet.

    Cuts that are connected have one middle in common: the mean of the places where they meet, or a place inside the
    model that more of them see.

    Parameters
    ----------
    points : (n, 3) float64
    cuts : (k, 2) int64
        Edges that faces of different parts have in common.
    meeting : (n,) bool
        Vertices where more than two of these edges meet.
    discs : Discs

    Returns
    -------
    ways : dict of int -> (s, 3) float64
        For each such vertex, points from there to the middle, which is the last.
    """
    if not meeting.any():
        return {}
    used, place = renumbered(cuts)
    n_networks, network = components(len(used), *place.T)
    here = meeting[used]
    own, vertex = network[here], used[here]
    middles = sums_by(own, points[vertex], n_networks)
    middles /= np.maximum(np.bincount(own, minlength=n_networks), 1)[:, None]
    of_cut = network[place[:, 0]]
    step = sums_by(of_cut, distances_between(points, *cuts.T), n_networks)
    step /= np.maximum(np.bincount(of_cut, minlength=n_networks), 1)
    ways = {}
    for one in np.unique(own).tolist():
        starts = vertex[own == one]
        edges = cuts[of_cut == one]
        found = _best(_Network(points, starts, _stretches(edges, starts), discs), middles[one], float(step[one]))
        ways.update(zip(starts.tolist(), found, strict=True))
    return ways


def _stretches(edges: np.ndarray, ends: np.ndarray) -> list[list[int]]:
    """The vertices along connected edges, (k, 2), from each of some ends to another one; those back to it are left."""
    beside: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    stop, found = set(ends.tolist()), []
    for start in sorted(stop):
        for step in beside[start]:
            walk = [start, step]
            while walk[-1] not in stop and len(beside[walk[-1]]) == 2:
                a, b = beside[walk[-1]]
                walk.append(b if a == walk[-2] else a)
            if walk[-1] in stop and walk[-1] > start:
                found.append(walk)
    return found


@dataclass(frozen=True, eq=False)
class _Network:
    """Connected cuts, and what their caps need.

    points : (n, 3) float64, of the model. starts : (k,) int64, vertices where more than two cuts meet. stretches : the
    vertices along the cuts from one of these to another. discs : what makes the caps. Ways to a middle are a list of
    (s, 3), one for each of the starts.
    """

    points: np.ndarray
    starts: np.ndarray
    stretches: list[list[int]]
    discs: Discs

    @property
    def places(self) -> np.ndarray:
        """(k, 3) float64, where the starts are."""
        return self.points[self.starts]

    def curves(self, ways: list[np.ndarray]) -> Iterator[np.ndarray]:
        """Each stretch closed by the ways from its ends to the middle, as it will be seen from both sides."""
        from_start = dict(zip(self.starts.tolist(), ways, strict=True))
        for stretch in self.stretches:
            onwards, back = apart(from_start[stretch[-1]], from_start[stretch[0]])
            curve = np.concatenate([self.points[stretch], onwards, back[:-1][::-1]])
            curve = curve.astype(np.float32).astype(np.float64)
            yield curve[common_order(curve)]

    def faults(self, ways: list[np.ndarray], effort: int, most: int) -> int:
        """How often the caps to the middle cross something or each other; it is not asked beyond most.

        effort : how far to go for caps that do not, see discs.PLAIN.
        """
        faults, sheets = 0, []
        for curve in self.curves(ways):
            found = self.discs.tried(curve, effort=effort)
            faults += found.faults
            if faults >= most:
                return faults
            if found.disc is not None:
                sheets.append((np.concatenate([curve, found.disc.places]), found.disc.triangles))
        return faults + len(_crossings(sheets))

    def faults_if_closed(self, ways: list[np.ndarray], effort: int, most: int) -> int:
        """What ``faults`` tells if all caps can be made; ``most`` if not."""
        faults = self.faults(ways, effort, most)
        if faults < most and all(self.discs.tried(curve).disc is not None for curve in self.curves(ways)):
            return faults
        return most

    def note(self, ways: list[np.ndarray]) -> None:
        """Note which caps to the middle cross each other; what else they cross ``discs`` notes itself."""
        sheets, used = [], []
        for stretch, curve in zip(self.stretches, self.curves(ways), strict=True):
            disc = self.discs.tried(curve).disc
            if disc is not None:
                sheets.append((np.concatenate([curve, disc.places]), disc.triangles))
                used.append(stretch)
        pairs, count = np.unique(_crossings(sheets), axis=0, return_counts=True)
        for (a, b), times in zip(pairs.tolist(), count.tolist(), strict=True):
            self.discs.note(np.array(used[a] + used[b]), times)


def _best(network: _Network, mean: np.ndarray, step: float) -> list[np.ndarray]:
    """Of several middles with ways to them the first whose caps cross nothing, else the one whose caps do so least."""
    tried, hopeless = [], _ENDLESS
    for ways in _choices(network, mean, step):
        faults = network.faults(ways, PLAIN, hopeless)
        if not faults:
            return ways
        hopeless = min(hopeless, _HOPELESS * faults)
        tried.append((faults, len(tried), ways))
        if len(tried) >= _FIRST and len(tried) * len(network.stretches) >= _CAPS:
            break
    # No plain caps will do: of the middles, those first whose caps cross least.
    best, least = tried[0][2], _ENDLESS
    for known, _, ways in sorted(tried, key=itemgetter(0, 1)):
        if known >= hopeless:
            break
        faults = network.faults(ways, LED_IN, least)
        if faults < least:
            best, least = ways, faults
        if not faults:
            return ways
    several = _several_middles(network)
    if several is not None:
        faults = network.faults(several, LED_IN, least)
        best = several if faults < least else best
    network.note(best)
    return best


def _several_middles(network: _Network) -> list[np.ndarray] | None:
    """Ways over several middles, from one to the next by lines that caps have in common; None if there are none.

    Around a handle, no place is seen from all others. The middles are those of groups of places between which few
    stretches go; each goes in turn where caps cross least, as long as that helps, twice at most.
    """
    places = network.places
    number = {vertex: index for index, vertex in enumerate(network.starts.tolist())}
    pairs = np.array([(number[stretch[0]], number[stretch[-1]]) for stretch in network.stretches]).reshape(-1, 2)
    sides = nested_sides(places, pairs)
    if not len(sides):
        return None
    through = np.append(sides, np.ones((1, len(places)), bool), axis=0).T  # middles on the way from each place
    options = [_places(places[own], network.discs) for own in own_places(sides)]
    options = [[*own, *(other[0] for other in options if other is not own)] for own in options]

    def faults(effort: int, tried: np.ndarray, most: int) -> int:
        return network.faults_if_closed([tried[here] for here in through], effort, most)

    middles, least = np.array([own[0] for own in options]), _ENDLESS
    for effort in (PLAIN, PLAIN, LED_IN):
        least = _ENDLESS if effort == LED_IN else least
        for index, own in enumerate(options):
            middles, least = _with_best(middles, index, own, partial(faults, effort), least)
        if not least:
            break
    return [middles[here] for here in through] if least < _ENDLESS else None


def _with_best(middles: np.ndarray, index: int, options: list[np.ndarray], faults: Callable[[np.ndarray, int], int],
               least: int) -> tuple[np.ndarray, int]:
    """Middles, (m, 3), with one of them where the caps have fewest faults, and how many these are.

    options : places for the one at ``index``. faults : of middles, not asked beyond a number, see ``_Network.faults``.
    """
    for place in (middles[index], *options):
        tried = middles.copy()
        tried[index] = place
        # A line between two middles in one place would have no length.
        found = faults(tried, least) if len(np.unique(tried, axis=0)) == len(tried) else least
        if found < least:
            middles, least = tried, found
    return middles, least


def _places(starts: np.ndarray, discs: Discs) -> list[np.ndarray]:
    """Places for the middle of some places on the surface, (k, 3), the mean of which is the first."""
    mean = starts.mean(axis=0)
    body = discs.around(starts, np.append(starts, mean[None], axis=0), _WIDER)
    if body is None or (body.own < 0).any():
        return [mean]
    return _middles(starts, mean, body, discs.side(mean[None], body))[:_OPTIONS]


def apart(one: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two ways to a middle, (s, 3) and (t, 3), up to the first place from which they are the same."""
    n = 1
    while n < min(len(one), len(other)) and np.array_equal(one[-n - 1], other[-n - 1]):
        n += 1
    return one[: len(one) - n + 1], other[: len(other) - n + 1]


def _choices(network: _Network, mean: np.ndarray, step: float) -> Iterator[list[np.ndarray]]:
    """Ways from the starts to one place each time."""
    places, discs = network.places, network.discs
    yield [mean[None]] * len(places)
    stretches = network.stretches
    curve = np.concatenate([network.points[stretch] for stretch in stretches]) if stretches else places
    body = discs.around(places, np.append(curve, mean[None], axis=0), _WIDER)
    if body is None or not step > 0 or (body.own < 0).any():
        return
    share = (arange(1, _TRIED) / _TRIED)[:, None, None]
    side = discs.side(((1 - share) * places + share * mean).reshape(-1, 3), body)
    for middle in _middles(places, mean, body, side):
        tried = (1 - share) * places + share * middle
        away = np.linalg.norm(tried - places, axis=2).ravel()
        near = (side * body.heights(tried.reshape(-1, 3)) > -_NEAR * away).reshape(_TRIED - 1, -1).any(axis=0)
        yield [_bent(place, middle, step, body, side) if bent else middle[None]
               for place, bent in zip(places, near.tolist(), strict=True)]


def _crossings(sheets: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Which of some surfaces, points and triangles each, cross each other: two for each pair of triangles, (k, 2)."""
    if not sheets:
        return np.empty((0, 2), np.int64)
    count = [len(every) for every, _ in sheets]
    places, number = np.unique(np.concatenate([every for every, _ in sheets]), axis=0, return_inverse=True)
    own = np.concatenate([one + before for (_, one), before in zip(sheets, cumsum(count) - count, strict=True)])
    triangles = number.ravel()[own]
    sheet = np.repeat(arange(len(sheets)), [len(one) for _, one in sheets])
    tree = search_tree(places, triangles)
    pairs = sheet[crossing(tree, tree, triangles, triangles)]
    return pairs[pairs[:, 0] != pairs[:, 1]]


def _middles(starts: np.ndarray, mean: np.ndarray, body: BodySurface, side: float) -> list[np.ndarray]:
    """Places for a middle: the mean of some places, half the way through the body from there, what most of them see.

    starts : (k, 3), the points that the body has as its own.
    """
    on, normal = body.nearest(mean[None])
    origins = np.concatenate([on, starts])
    inwards = -side * np.concatenate([normal, body.vertex_normals[body.own]])
    room = body.free_way(origins, inwards, 1e-4 * box_diagonal(body.points))
    known = np.isfinite(room)
    places = (origins + 0.5 * np.where(known, room, 0.0)[:, None] * inwards)[known]
    if not len(places):
        return [mean]
    seen = np.array([_sees(starts, np.broadcast_to(place, starts.shape), body) for place in places])
    order = np.lexsort((-rounded(lengths(places - mean)), -seen.sum(axis=1))).tolist()
    found, least = [mean, places[0], places[order[0]]], _APART * box_diagonal(starts)
    for index in order:
        if len(found) < _MIDDLES and lengths(places[index] - found[1:]).min() > least:
            found.append(places[index])
    return found


def _sees(ends: np.ndarray, starts: np.ndarray, body: BodySurface) -> np.ndarray:
    """Whether nothing lies between some places and others, which may be on the surface, (k,) bool."""
    way = ends - starts
    length = np.linalg.norm(way, axis=1)
    way = way / np.maximum(length, 1e-300)[:, None]
    backwards = body.free_way(ends, -way, 1e-3 * float(np.median(length)))
    return np.minimum(backwards, body.free_way(starts, way, 1e-3 * float(np.median(length)))) > 0.999 * length


def _bent(start: np.ndarray, middle: np.ndarray, step: float, body: BodySurface, side: float) -> np.ndarray:
    """A way from a place on the surface to a middle, pushed off the surface."""
    n = int(np.clip(np.linalg.norm(middle - start) / step, 2, _MOST))
    share = (arange(1, n) / n)[:, None]
    way = (1 - share) * start + share * middle
    held = np.zeros(len(way), bool)
    for _ in range(_ROUNDS):
        margin = _AWAY * np.linalg.norm(way - start, axis=1)
        on, normal = body.nearest(way)
        out = side * ((way - on) * normal).sum(axis=1) > -0.5 * margin
        if not out.any():
            break
        way[out] = on[out] - side * normal[out] * margin[out, None]
        held |= out
        known = np.concatenate([[0], np.flatnonzero(held) + 1, [n]])
        fixed = np.concatenate([start[None], way, middle[None]])[known]
        way = np.stack([np.interp(arange(1, n), known, fixed[:, axis]) for axis in range(3)], axis=1)
    return np.concatenate([way, middle[None]])

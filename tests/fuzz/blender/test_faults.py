# SPDX-License-Identifier: GPL-3.0-or-later
"""All or nothing: whatever line of a command or a slider raises, all data is as it was before.

A fault is put in before a line of scene/ or operators/, the command is called, and all data blocks are compared. Where
Blender itself swallows an exception - in a handler, in the update function of a property that the program sets - the
command goes on, and its whole work has to be there.
"""

import importlib
import os
from contextlib import contextmanager
from pathlib import Path

import bpy
import numpy as np
import pytest
import shapes
from blender.operators.test_every_operator import CASES, SITUATIONS, no_job, set_up  # noqa: F401
from fuzz import budget
from fuzz.blender.faults import Injector, places
from snapshot import changes, snapshot

#: Of the fixed slice: one of so many places, in each command others.
STEP = 45
# What "cancel" stops is no data, and what needs a viewport does nothing here.
COMMANDS = [name for name, case in CASES.items() if name != "cancel" and "OBJECT" not in case.refuses]


def result(obj):
    return obj.data.reeb_parts


#: What the user can do without a command: a name, how it is done, and how it is prepared.
SLIDERS = {
    "detail": (lambda obj: result(obj), "detail", 0.95),
    "fewer": (lambda obj: result(obj), "detail", 0.0),
    "number": (lambda obj: result(obj), "n_parts", 2),
    "name": (lambda obj: result(obj).parts[1], "name", "Leg"),
    "color": (lambda obj: result(obj).parts[1], "color", (0.1, 0.6, 0.3)),
    "lock": (lambda obj: result(obj).parts[1], "locked", True),
    "click": (lambda obj: result(obj), "active", 2),
    "explode": (lambda obj: obj.reeb_parts_made, "explode", 0.5),
    "graph": (lambda obj: bpy.context.scene.reeb_parts, "graph", False),
    "node size": (lambda obj: bpy.context.scene.reeb_parts, "node_size", 0.05),
    "palette": (lambda obj: bpy.context.scene.reeb_parts, "palette", "Pastel"),
    "preset": (lambda obj: bpy.context.scene.reeb_parts, "preset", "Berretti 2009"),
}


@pytest.fixture(scope="module")
def small(package):
    """A trunk with branches, of few faces."""
    return shapes.tube_tree(step=0.25)


class Keys:
    """In place of random keys: the same in every trial, so that what comes out can be compared."""

    count = 0

    @classmethod
    def token_hex(cls, size):
        cls.count += 1
        return f"{cls.count:0{2 * size}x}"


@pytest.fixture(autouse=True)
def same_keys(monkeypatch, package):
    """Pieces get the same keys in every trial."""
    monkeypatch.setattr(importlib.import_module(f"{package}.scene.pieces.origins"), "secrets", Keys)


@contextmanager
def silent():
    """What Blender says of the faults is not shown."""
    kept, sink = [os.dup(1), os.dup(2)], os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(sink, stream)
    try:
        yield
    finally:
        for stream, copy in zip((1, 2), kept, strict=True):
            os.dup2(copy, stream)
            os.close(copy)
        os.close(sink)


class Trial:
    """A command or a slider, tried again and again with faults.

    Parameters
    ----------
    package : str
    prepare : callable() -> callable() -> object
        Makes the scene, and returns what is tried.
    allowed : callable() -> list of dict
        Snapshots of states that are right beside those before and after, when the scene is made.
    """

    def __init__(self, package, prepare, allowed=lambda: []):
        root = str(Path(importlib.import_module(package).__file__).parent)
        self.folders = tuple(f"{root}/{name}/" for name in ("scene", "operators"))
        self.quiet = importlib.import_module(f"{package}.scene.property_updates")
        self.transaction = importlib.import_module(f"{package}.scene.transaction")
        self.prepare, self.allowed = prepare, allowed
        self.reset()
        self.work()  # what is kept in memory is there from now on
        self.reset()
        counter = Injector(self.folders)
        counter.run(self.work)
        self.lines = counter.lines
        self.after = snapshot()
        self.reset()

    def reset(self):
        bpy.ops.wm.read_homefile(use_empty=True)
        self.work = self.prepare()
        bpy.ops.ed.undo_push(message="before")
        self.others = self.allowed()
        self.before = snapshot()
        Keys.count = 0  # those of the command follow

    def run(self, place):
        """The command with a fault before the place-th line: the injector, and what was returned; None if it raised."""
        injector = Injector(self.folders, place)
        Keys.count = 0
        with silent():
            try:
                return injector, injector.run(self.work)
            except Exception:  # noqa: BLE001 - Blender makes other exceptions of it
                return injector, None

    def fault(self, place):
        """What is wrong after a fault before the place-th line: where it was, and the changes; None if nothing is."""
        injector, done = self.run(place)
        if not injector.done:  # a tree that a trial before left in memory makes a pick shorter
            self.reset()
            injector, done = self.run(place)
        assert injector.done
        found = snapshot()
        state = [self.quiet.is_quiet(), bool(self.transaction._open)]
        wanted = [self.before] if done is None else [self.before, *self.others, self.after]
        wrong = min((changes(want, found) for want in wanted), key=len)
        if found != self.before:
            self.reset()
        file, line = injector.lines[-1]
        name = Path(file).relative_to(Path(self.folders[0]).parent).as_posix()
        return (name, line, wrong, state) if wrong or any(state) else None


def check(trial, chosen):
    """Try faults at some places; those after which something is wrong."""
    found = [trial.fault(place) for place in chosen]
    budget.count("faults", len(chosen))
    return [wrong for wrong in found if wrong is not None]


def some(trial, seed):
    """Places of one round: in the fixed slice some all over the command, else all, in an order of their own."""
    every = places(trial.lines)
    if budget.SECONDS:
        return np.random.default_rng(seed).permutation(every).tolist()[:200]
    return every[seed % STEP :: STEP]


def command(package, name, situation, make, small, tmp_path):
    """Makes a scene and returns the call of an operator."""
    folders = iter(range(10**6))

    def prepare():
        folder = tmp_path / f"{name}{next(folders)}"
        folder.mkdir()
        arguments = set_up(package, name, situation, make, small, folder)
        return lambda: getattr(bpy.ops.reeb_parts, name)(**arguments)

    return prepare


@pytest.mark.parametrize("name", COMMANDS)
def test_commands(package, name, make, small, tmp_path, no_job):  # noqa: F811
    if budget.SECONDS:  # all are tried below
        return
    trial = Trial(package, command(package, name, "OBJECT", make, small, tmp_path))
    assert check(trial, some(trial, COMMANDS.index(name))) == []


@pytest.mark.parametrize("name", SLIDERS)
def test_sliders(package, name, make, small):
    trial = Trial(package, *slider(package, name, make, small))
    assert check(trial, some(trial, 0)) == []


def slider(package, name, make, small):
    """Makes a scene and returns the change of a property; and the state in which only it is changed."""
    find, prop, value = SLIDERS[name]

    def prepare():
        make(small)
        bpy.ops.reeb_parts.decompose(materials=True)
        owner = find(bpy.context.object)
        return lambda: setattr(owner, prop, value) or True

    def only_the_property():
        # Before the first line of ours, Blender has changed the property already.
        quiet = importlib.import_module(f"{package}.scene.property_updates")
        owner = find(bpy.context.object)
        before = getattr(owner, prop)
        before = before[:] if prop == "color" else before
        was_set = owner.is_property_set(prop)
        with quiet.quiet():
            setattr(owner, prop, value)
            touched = snapshot()
            setattr(owner, prop, before)
            if not was_set:
                owner.property_unset(prop)
        return [touched]

    return prepare, only_the_property


def test_any_command_in_any_situation(package, make, small, tmp_path, no_job):  # noqa: F811
    found = []
    for case in budget.stored("fault"):
        trial = Trial(package, command(package, case["command"], case["situation"], make, small, tmp_path))
        file, line = case["before"].split(":")
        where = [i for i in places(trial.lines) if trial.lines[i][0].endswith(file) and trial.lines[i][1] == int(line)]
        assert check(trial, where) == []
    for seed in budget.rounds(0):
        rng = np.random.default_rng(seed)
        name, situation = rng.choice(COMMANDS), rng.choice(SITUATIONS)
        if situation in CASES[name].refuses:
            continue
        folder = tmp_path / str(seed)
        folder.mkdir()
        trial = Trial(package, command(package, str(name), str(situation), make, small, folder))
        for file, line, wrong, state in check(trial, some(trial, seed)):
            found.append((name, situation, file, line, wrong[:3], state))
            budget.store("fault", {"command": str(name), "situation": str(situation), "before": f"{file}:{line}"})
    assert found == []

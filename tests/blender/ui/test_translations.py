# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything can be said in other languages, and every language we have says it all.

Blender as a module knows no languages; what Blender really says is tried in a full one.
"""

import importlib
import os
import re
import signal
import string
from collections import Counter
from pathlib import Path

import addon_utils
import bpy
import messages
import pytest
from bpy.app.translations import pgettext_iface as iface_
from systems import unix

ENGLISH = {
    "no object": "There is no active object. Select a mesh and try again.",
    "kind": "Sign is not a mesh but of the type text.",
    "too few faces": "The mesh has only 1 of the 4 faces that the smallest solid has. Choose a larger mesh.",
    "report": r"Info: 5 parts in \d+\.\d s",
    "note": "Tree was decomposed as it is before its modifier was applied.",
    "facts": [r"5 parts in \d+\.\d\d s", "10 nodes, 9 arcs, 0 loops"],
    "locked": "Part 01 is locked. Unlock it in the list first.",
    "progress": "BODY: reeb graph",
    "SIGKILL": r"There is not enough memory to decompose Tree \(\d+ vertices\); nothing was changed\. Close .*\.",
    "SIGSEGV": r"The process that decomposed Tree ended unexpectedly \(signal 11\); nothing was changed\. Try .*\.",
    "button": "Merge Parts",
    "tooltip": "Close Holes",
}
GERMAN = {
    "no object": "Es gibt kein aktives Objekt. Bitte ein Mesh auswählen und erneut versuchen.",
    "kind": "Sign ist kein Mesh, sondern vom Typ Text.",
    "too few faces": "Das Mesh hat nur 1 der 4 Flächen, die der kleinste Körper hat. Bitte ein größeres Mesh wählen.",
    "report": r"Info: 5 Teile in \d+\.\d s",
    "note": "Tree wurde zerlegt, wie es vor Anwendung seines Modifikators ist.",
    "facts": [r"5 Teile in \d+\.\d\d s", "10 Knoten, 9 Bögen, 0 Schleifen"],
    "locked": "Part 01 ist gesperrt. Bitte zuerst in der Liste entsperren.",
    "progress": "BODY: Reeb-Graph",
    "SIGKILL": r"Der Speicher reicht nicht, um Tree zu zerlegen \(\d+ Punkte\); nichts wurde geändert\. Bitte .*\.",
    "SIGSEGV": r"Der Prozess, der Tree zerlegte, endete unerwartet \(signal 11\); nichts wurde geändert\. Bitte .*\.",
    "button": "Teile zusammenführen",
    "tooltip": "Löcher schließen",
}
CHINESE = {
    "no object": "没有活动物体。请选择一个网格并重试。",
    "kind": "Sign 不是网格，而是 文本 类型。",
    "too few faces": "网格只有 1 个面，而最小的实体有 4 个面。请选择更大的网格。",
    "report": r"信息: 5 个部件，用时 \d+\.\d 秒",
    "note": "Tree 按应用其修改器之前的状态分解。",
    "facts": [r"5 个部件，用时 \d+\.\d\d 秒", "10 个节点，9 条弧，0 个环"],
    "locked": "Part 01 已锁定。请先在列表中解锁。",
    "progress": "BODY: Reeb 图",
    "SIGKILL": r"内存不足，无法分解 Tree（\d+ 个顶点）；未更改任何内容。请.*。",
    "SIGSEGV": r"分解 Tree 的进程意外终止（signal 11）；未更改任何内容。请.*。",
    "button": "合并部件",
    "tooltip": "封闭孔洞",
}
SAID = {"en_US": ENGLISH, "de_DE": GERMAN, "zh_HANS": CHINESE}
if not bpy.app.build_options.international:
    SAID = {"DEFAULT": ENGLISH}


@pytest.fixture
def languages(package):
    """The dictionaries by language, as Blender gets them."""
    return importlib.import_module(f"{package}.ui.translations").dictionary()


@pytest.fixture
def wanted(package):
    """Every message that is looked up, as (context, English text)."""
    return messages.registered_messages(package) | messages.written_messages(messages.sources(package))


def test_messages_are_found_where_they_are(wanted):
    some = {
        ("Operator", "Merge Parts"), ("*", "Clear brings your own back"), ("*", "Close Holes"), ("*", "Boundaries"),
        ("*", "{n} border {n:edge|edges}: the surface is open there."), ("*", "distances"),
        ("*", "{n} {n:part is|parts are} {name} now"),
        ("Operator", "Seams"), ("*", "Which parts to use"), ("*", "Nothing is computed again"), ("*", "OBJ"),
    }
    texts = "\n".join(f"{context}|{text}" for context, text in wanted)
    for context, text in some:
        assert re.search(rf"^{re.escape(context)}\|.*{re.escape(text)}", texts, re.MULTILINE), text


def test_every_language_says_everything_and_nothing_else(languages, wanted):
    assert {"de", "zh_HANS"} <= languages.keys()
    faults = []
    for code, dictionary in languages.items():
        file = f"ui/translations/{code}.py"
        faults += [f"{file} lacks {text!r} ({context})" for context, text in sorted(wanted - dictionary.keys())]
        faults += [f"{file} has {text!r} ({context}), which is said no longer"
                   for context, text in sorted(dictionary.keys() - wanted)]
        assert all(text.strip() for text in dictionary.values())
    assert not faults, "\n" + "\n".join(faults)


def test_values_have_their_places_in_every_language(languages):
    def places(text):
        fields = [field for field in string.Formatter().parse(text) if field[1] is not None]
        # Words that a number chooses may be there or not, but only of numbers that have a place.
        chosen, shown = ([field for field in fields if ("|" in field[2]) == by_number] for by_number in (True, False))
        assert {field[1] for field in chosen} <= {field[1] for field in shown}
        return Counter(field[1:] for field in shown)

    assert places("{n} of {total}, {share:.1f}") == places("{share:.1f}: {n}/{total}") != places("{n} of {total}")
    for dictionary in languages.values():
        for (_, english), text in dictionary.items():
            assert places(english) == places(text)
            assert english.count("    ") == text.count("    ")  # between the keys in the status bar


# Said of several only; of one, nothing is said or something else.
OF_SEVERAL = {
    "{n} faces whose borders run along each other, but do not meet, are treated as joined.",
    "{n} pieces that touch, or nearly so, form one body; with Pieces: Separate each is decomposed on its own.",
    "{n} objects share this mesh; all of them show its parts.",
    "{n} pieces form {bodies} bodies; what touches is decomposed together.",
    "{name} was decomposed as it is before its {n} modifiers were applied.",
    "{n} loose parts are decomposed each on its own.", "All {n} faces have zero area. Check the scale of the object.",
    "There would be more than {n} pieces. Is the bed in millimeters?",
    "Hints must be one whole number for each of the {n} faces.",
    "There is not enough memory to decompose {name} ({n} vertices); nothing was changed. Close other programs, or "
    "decimate a copy and decompose that.",
    "{n} {n:triangle faces inwards or against its|triangles face inwards or against their} neighbors.",  # a verb
    "{n} loose parts are decomposed each on its own; {small} small {small:one is one|ones are one} part each.",
}


def test_a_key_is_called_the_same_in_all_that_says_what_keys_do(languages):
    """In German Enter was Eingabe here and Enter there."""
    for code, word in (("de", "Eingabe"), ("zh_HANS", "回车")):
        for (_, english), text in languages[code].items():
            if "Enter" in english:
                assert word in text
                assert "Enter" not in text


def test_words_agree_with_one(package, wanted):
    count = importlib.import_module(f"{package}.core.sentence").Count
    several = re.compile(
        r"\b1 (?!of )(?:[a-z]+ ){0,2}?(parts|faces|edges|vertices|pieces|objects|models|files|borders|cuts|bones|hulls|"
        r"notes|nodes|arcs|loops|rings|modifiers|are|have|were)\b", re.IGNORECASE)
    faults = []
    for _, text in wanted:
        fields = [field for field in string.Formatter().parse(text) if field[1] is not None]
        if text in OF_SEVERAL or not fields or not all(re.fullmatch(r"|[^.]*\|.*", field[2]) for field in fields):
            continue
        said = text.format(**{field[1]: count(1) if field[1] in {"n", "small", "objects", "rings"} else "x"
                              for field in fields if "|" not in field[2]} | {"total": count(2)})
        faults += [said] if several.search(said) else []
    assert not faults, "\n" + "\n".join(faults)


def test_no_text_is_made_where_nobody_can_translate_it(package):
    trees = messages.sources(package)
    assert {"core/mesh/triangles.py", "operators/decompose.py", "ui/panel.py"} <= trees.keys()
    assert messages.made_here(trees) == []


@pytest.mark.parametrize(("code", "found"), [
    ('def f(self):\n    self.report({"INFO"}, f"{n} parts")', 1),
    ('def f(self):\n    self.report({"INFO"}, "parts")', 1),
    ('def f(self):\n    text = f"{n} parts"\n    layout.label(text=text)', 1),
    ('def f(self):\n    layout.operator("x", text=iface_(f"{n} parts"))', 1),
    ('def f(self):\n    raise SceneError("No parts of {name}.".format(name=name))', 1),
    ('def work(self):\n    return f"{n} parts"', 1),
    ('def f(self):\n    raise MeshError(f"{n} parts")', 1),
    ('def f(self):\n    self.report({"INFO"}, rpt_("{n} parts").format(n=3))', 0),
    ('def f(self):\n    layout.label(text="parts")', 0),
    ('def f(self):\n    layout.label(text=f"{share:.1f} %")', 0),
    ('def f(self):\n    raise MeshError(Sentence("{n} parts", n=3))', 0),
])
def test_text_that_nobody_can_translate_is_found(code, found):
    assert len(messages.made_here({"ui/x.py": messages.ast.parse(code)})) == found


@pytest.fixture(params=SAID)
def said(request):
    """What is said in a language, which Blender speaks for the time of the test."""
    view = bpy.context.preferences.view
    switches = ("use_translate_interface", "use_translate_tooltips", "use_translate_reports")
    before = view.language, *(getattr(view, name) for name in switches)
    view.language = request.param
    for name in switches:
        setattr(view, name, True)
    yield SAID[request.param]
    view.language = before[0]
    for name, value in zip(switches, before[1:], strict=True):
        setattr(view, name, value)


def test_blender_says_what_our_dictionaries_say(said, languages):
    """Where Blender knows a text, its own translation is shown: ours is the same, or has a context of our own."""
    language = bpy.context.preferences.view.language
    dictionary = languages.get(language, languages.get(language.split("_")[0], {}))
    assert bool(dictionary) == (said is not ENGLISH)
    other = {(context, text): iface_(text, context) for context, text in dictionary}
    assert [(key, other[key], text) for key, text in dictionary.items() if other[key] != text] == []


def test_errors_of_the_scene(said):
    with pytest.raises(RuntimeError, match=re.escape(said["no object"])):
        bpy.ops.reeb_parts.decompose()


def test_a_kind_of_object_is_written_as_the_language_does(said):
    """Text is the same word in German, where nouns have a capital."""
    bpy.ops.object.text_add()
    bpy.context.object.name = "Sign"
    with pytest.raises(RuntimeError, match=re.escape(said["kind"])):
        bpy.ops.reeb_parts.decompose()


def test_errors_of_core(said, make):
    make(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
    with pytest.raises(RuntimeError, match=re.escape(said["too few faces"])):
        bpy.ops.reeb_parts.decompose()


def test_reports(said, obj, capfd):
    bpy.ops.reeb_parts.decompose()
    assert re.search(said["report"], capfd.readouterr().out)
    obj.data.reeb_parts.parts[0].locked = True
    with pytest.raises(RuntimeError, match=re.escape(said["locked"])):
        bpy.ops.reeb_parts.split()


def test_progress(said, package):
    jobs = importlib.import_module(f"{package}.scene.runs.jobs")
    job = jobs.Job([], None)
    job.stage, job.of = "reeb graph", "BODY"
    assert job.text == said["progress"]
    progress_text = importlib.import_module(f"{package}.ui.panel").progress_text
    job.of = "kit"  # names stay as they are: it was Kit
    assert progress_text(job) == said["progress"].replace("BODY", "kit")
    job.of = ""
    assert progress_text(job) == said["progress"].removeprefix("BODY: ").replace("reeb graph", "Reeb graph")


@unix
def test_why_there_is_no_result(said, obj, package):
    jobs, bridge, parameters = (
        importlib.import_module(f"{package}.{name}") for name in ("scene.runs.jobs", "scene.bridge", "core.parameters"))
    for number in (signal.SIGKILL, signal.SIGSEGV):
        job = jobs.Job([("Tree", bridge.read_shape(obj))], parameters.Parameters(base_spacing=0.0005))
        job.start()
        while job.running:
            if job.stage:
                os.kill(job.pid, number)
            job.poll()
        assert re.fullmatch(said[number.name], str(job.error))


def test_the_panel_also_in_a_file_that_was_opened_again(said, obj, package, tmp_path):
    obj.modifiers.new("Bevel", "BEVEL")
    bpy.ops.reeb_parts.decompose()
    path = str(tmp_path / "tree.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    result = bpy.data.objects["Tree"].data.reeb_parts
    assert said["note"] in importlib.import_module(f"{package}.scene.result.notes").spoken(result)
    lines = importlib.import_module(f"{package}.ui.advanced_panel").facts(result)
    for line, expected in zip(lines, said["facts"], strict=True):
        assert re.fullmatch(expected, line)


def test_json_is_english_in_every_language(said, obj, package):
    obj.modifiers.new("Bevel", "BEVEL")
    bpy.ops.reeb_parts.decompose()
    report = importlib.import_module(f"{package}.scene.saving.object_report").object_report(obj)
    assert ENGLISH["note"] in report["notes"]
    assert report["parts"][0]["name"] == "Part 01"
    assert "distances" in report["seconds"]


def test_notes_of_a_file_from_before_there_were_translations(obj, package):
    obj.modifiers.new("Bevel", "BEVEL")
    bpy.ops.reeb_parts.decompose()
    obj.data.reeb_parts.property_unset("note_words")
    assert ENGLISH["note"] in importlib.import_module(f"{package}.scene.result.notes").spoken(obj.data.reeb_parts)


def test_switched_off_leaves_no_translations(said, package):
    assert iface_("Merge Parts", "Operator") == said["button"]
    assert iface_("Close Holes") == said["tooltip"]
    addon_utils.disable(package)
    try:
        assert iface_("Merge Parts", "Operator") == ENGLISH["button"]
        assert iface_("Close Holes") == ENGLISH["tooltip"]
    finally:
        addon_utils.enable(package)
    assert iface_("Close Holes") == said["tooltip"]


def test_translations_are_shipped(package):
    translations = importlib.import_module(f"{package}.ui.translations")
    files = {path.stem for path in Path(translations.__file__).parent.glob("*.py")} - {"__init__"}
    assert files == translations.LANGUAGES.keys()

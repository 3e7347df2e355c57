# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar dragged narrow, in a real window and two languages: what stands where, and how wide it is.

Executed inside Blender as driver.py is, which says how.
"""

import json
import os
import sys

import blf
import bpy

sys.path.append(os.path.dirname(__file__))
import pointer
from spot import spot

SEEN = {}
ACROSS = 4  # places in a row at which Blender is asked what is there
LANGUAGES = {160: "de_DE", 126: "en_US"}  # by the width of the sidebar


def steps():
    """One step after the other; yields the seconds to wait."""
    yield from pointer.spot_alone(maximised=True)
    yield from pointer.push("reeb_parts.decompose")
    yield from pointer.until(lambda: len(spot().data.reeb_parts.parts), pointer.PATIENCE)
    yield 1.0
    bpy.ops.reeb_parts.suggest_names()
    yield 0.5
    bpy.context.preferences.use_preferences_save = False  # the next driver speaks English
    SEEN["parts"] = len(spot().data.reeb_parts.parts)
    SEEN["shares"] = yield from shares_of("front piece", "front pieces", "front pieces 12")
    pointer.shot("wide.png")
    for width, code in LANGUAGES.items():
        yield from narrow_to(width)
        speak(code)
        yield 0.5
        SEEN[str(width)] = yield from seen_now()
        pointer.shot(f"{width}_{code}.png")
    (pointer.OUT / "seen.json").write_text(json.dumps(SEEN, indent=2))


def shares_of(*names):
    """With which names the largest part has its share in the list: while all rows are seen, and while it scrolls."""
    part, found = max(spot().data.reeb_parts.parts, key=lambda part: part.share), {}
    (listing,) = (module for name, module in sys.modules.items() if name.endswith("reeb_parts.ui.parts_list"))
    own, asked, before, most = listing._has_share, {}, part.name, listing.MOST_ROWS
    listing._has_share = lambda room, name, *rest: asked.setdefault(name, own(room, name, *rest))
    for key, rows in (("all", most), ("scrolled", listing.ROWS)):
        listing.MOST_ROWS, found[key] = rows, []
        for name in names:
            part.name = name
            for _ in range(2):
                asked.clear()
                pointer.region("UI").tag_redraw()
                yield 0.5
            found[key] += [name] if asked[name] else []
            pointer.shot(f"share_{key}_{name}.png")
    listing._has_share, listing.MOST_ROWS, part.name = own, most, before
    return found


def narrow_to(width):
    """Drag the edge of the sidebar until it is so wide."""
    for aside in (2, 0, 3, 1, -1):  # how near to the edge Blender takes it depends on the resolution
        sidebar = pointer.region("UI")
        x, y = pointer.from_top(sidebar.x + aside, sidebar.y + 0.6 * sidebar.height)
        yield from pointer.drag([(x, y), (x + 10, y), (x + sidebar.width - width, y), (x + sidebar.width - width, y)])
        yield 0.4
        if abs(pointer.region("UI").width - width) <= 3:
            return
    raise LookupError(f"the sidebar is {pointer.region('UI').width} wide")


def speak(code):
    view = bpy.context.preferences.view
    view.language = code
    view.use_translate_interface = code != "en_US"


def seen_now():
    """What is in the sidebar: of each button and field its width, by what it calls or where its property is."""
    sidebar, step = pointer.region("UI"), 0.75 * pointer.unit()
    left, top = pointer.from_top(sidebar.x + 14, sidebar.y + sidebar.height - step)
    wide, found = sidebar.width - 52, {}  # from the left edge of the buttons to their right one
    for row in range(int(sidebar.height / step) - 1):
        at_once = {}
        for place in range(ACROSS):
            x, y = round(left + (place + 0.5) * wide / ACROSS), round(top + row * step)
            yield from arrive(x, y)
            shown = pointer.under()
            if shown:
                at_once[shown] = at_once.get(shown, 0) + wide / ACROSS
        for shown, width in at_once.items():
            found[shown] = max(found.get(shown, 0), width)
    return {"room": wide, "step": wide / ACROSS, "found": found, "words": words()}


def arrive(x, y):
    pointer.xdo("mousemove", x, y)
    at = x, bpy.context.window.height - y
    yield from pointer.until(lambda: max(abs(a - b) for a, b in zip(pointer.Arrival.at, at, strict=True)) < 2, 0.3)
    yield 0.02


def words():
    """How wide the words of each button are, as it is said now."""
    translated = bpy.app.translations.pgettext_iface
    said = {
        "reeb_parts.decompose": ("Decompose", "Operator"), "reeb_parts.cut": ("Cut", "Reeb Parts"),
        "reeb_parts.slide": ("Slide", "Reeb Parts"), "reeb_parts.paint": ("Paint", "Reeb Parts"),
        "reeb_parts.step_detail": ("Fewer", "Reeb Parts"), "reeb_parts.select": ("Select", "Operator"),
        "reeb_parts.isolate": ("Isolate", "Operator"), "reeb_parts.separate": ("Separate", "Operator"),
        "reeb_parts.suggest_names": ("Suggest Names", "Operator"),
    }
    blf.size(0, bpy.context.preferences.ui_styles[0].widget.points * bpy.context.preferences.system.ui_scale)
    return {name: blf.dimensions(0, translated(text, context))[0] for name, (text, context) in said.items()}

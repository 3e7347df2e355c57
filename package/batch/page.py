# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of all models of a batch, to search and to sort, in one file that needs no other."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from urllib.parse import quote

from ..core.uses.pictures import png_address
from ..output_files import write_files

PAGE = "index.html"
#: Models whose pictures are in the page itself; a page of more shows them from their folders, or it would not open.
EMBEDDED = 5_000
STYLE = """
body { font: 14px/1.4 system-ui, sans-serif; margin: 0; color: #222; background: #fff }
header { position: sticky; top: 0; background: #fff; border-bottom: 1px solid #ccc; padding: .7em 1.2em; z-index: 1;
  display: flex; gap: 1em; flex-wrap: wrap; align-items: center }
h1 { font-size: 1.1em; margin: 0 } input, select, button { font: inherit; padding: .25em .5em } #found { color: #555 }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: 12px; padding: 1.2em }
figure { margin: 0; border: 1px solid #ddd; border-radius: 6px; padding: 8px; overflow: hidden }
figure img { display: block; width: 128px; height: 128px; margin: 0 auto }
figcaption { font-size: 12px; overflow-wrap: anywhere } figcaption b { font-weight: 600 }
.failed { background: #fff4f0 }
.reason { display: block; color: #a33; font-size: 11px; max-height: calc(7 * 1.4em); overflow: auto } /* whole lines */
.none { height: 128px; display: grid; place-items: center; color: #a33 }
"""
SCRIPT = """
const models = JSON.parse(document.querySelector('#models').textContent);
const main = document.querySelector('main'), words = document.querySelector('#words');
const key = document.querySelector('#key'), down = document.querySelector('#down');
const found = document.querySelector('#found');
const STEP = 200;
let shown = models, count = 0;
function text(tag, words, kind) {
  const element = document.createElement(tag);
  element.textContent = words;
  if (kind) element.className = kind;
  return element;
}
function seconds(value) { return value < 10 ? Number(value.toPrecision(2)) : Math.round(value); }
function card(model) {
  const figure = document.createElement('figure'), caption = document.createElement('figcaption');
  const link = document.createElement('a');
  if (model.link) link.href = model.link;
  if (model.image) {
    const image = document.createElement('img');
    image.src = model.image; image.alt = model.name; image.loading = 'lazy';
    link.append(image);
  } else link.append(text('div', model.status, 'none'));
  caption.append(text('b', model.name), document.createElement('br'));
  if (model.status === 'done')
    caption.append(`${model.parts} ${model.parts === 1 ? 'part' : 'parts'}, ` +
                   `${model.faces.toLocaleString('en')} faces, ${seconds(model.seconds)}\\u00a0s`);
  else { figure.className = 'failed'; caption.append(text('span', model.status + ': ' + model.reason, 'reason')); }
  figure.append(link, caption);
  return figure;
}
function more() {
  const next = shown.slice(count, count + STEP);
  count += next.length;
  main.append(...next.map(card));
}
// Until there are cards below the window: a window that all of them fit into cannot be scrolled.
function fill() {
  while (count < shown.length && innerHeight + scrollY > document.body.scrollHeight - 800) more();
}
function update() {
  const wanted = words.value.toLowerCase().split(/\\s+/).filter(Boolean);
  shown = models.filter(m => wanted.every(w => m.text.includes(w)));
  const by = key.value, sign = down.getAttribute('aria-pressed') === 'true' ? -1 : 1;
  shown.sort((a, b) => {
    const x = a[by] ?? -1, y = b[by] ?? -1;
    return sign * (x < y ? -1 : x > y ? 1 : 0) || (a.name < b.name ? -1 : a.name > b.name ? 1 : 0);
  });
  found.textContent = `${shown.length} of ${models.length}`;
  main.replaceChildren(); count = 0; fill();
}
models.forEach(m => { m.text = [m.name, m.status, m.reason, ...m.notes].join(' ').toLowerCase(); });
words.addEventListener('input', update);
key.addEventListener('change', update);
down.addEventListener('click', () => {
  down.setAttribute('aria-pressed', down.getAttribute('aria-pressed') !== 'true'); update();
});
addEventListener('scroll', fill);
addEventListener('resize', fill);
// index.html#cow looks for cows.
function lookFor() {
  const hash = location.hash.slice(1);
  try { words.value = decodeURIComponent(hash); } catch { words.value = hash; }  // such as 50%
  update();
}
addEventListener('hashchange', lookFor);
lookFor();
"""
KEYS = (("name", "name"), ("parts", "number of parts"), ("faces", "faces"), ("loops", "loops"),
        ("seconds", "seconds"), ("status", "status"))


def write_page(out: Path, title: str, rows: Iterable[tuple[dict[str, Any], Path, Path]], total: int,
               read: Path) -> Path:
    """Write index.html.

    Parameters
    ----------
    out : Path
        Where.
    title : str
    rows : iterable of (record, path, folder)
        As ``tables.write_tables`` takes them.
    total : int
        How many there are.
    read : Path
        What the page must not be written over.

    Returns
    -------
    path : Path
    """
    models = [_entry(out, record, folder, total <= EMBEDDED) for record, _, folder in rows]
    path = out / PAGE
    write_files({path: page(title, models).encode()}, read)
    return path


def page(title: str, models: list[dict[str, Any]]) -> str:
    """The page as HTML. models : what the script shows of each."""
    # Within a script, only this could end it.
    data = json.dumps(models, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
    options = "".join(f'<option value="{key}">{name}</option>' for key, name in KEYS)
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title><style>{STYLE}</style></head><body>
<header><h1>{html.escape(title)}</h1>
<input id="words" type="search" placeholder="search names, reasons, notes" size="32" autofocus>
<label>sort by <select id="key">{options}</select></label>
<button id="down" type="button" aria-pressed="false">largest first</button><span id="found"></span></header>
<main></main>
<script type="application/json" id="models">{data}</script><script>{SCRIPT}</script></body></html>
"""


def _entry(out: Path, record: dict[str, Any], folder: Path, embedded: bool) -> dict[str, Any]:
    """What the page shows of a model."""
    model = record["model"]
    link = quote(os.fsencode(folder.relative_to(out).as_posix()))
    image = ""
    if "thumbnail.png" in record["files"]:
        image = f"{link}/thumbnail.png"
        if embedded:
            image = png_address((folder / "thumbnail.png").read_bytes())
    return {"name": record["name"], "status": record["status"], "reason": record["reason"],
            "parts": model.get("n_parts"), "faces": model.get("faces"), "loops": model.get("loops"),
            "seconds": model.get("seconds"), "notes": model.get("notes", []), "image": image,
            "link": f"{link}/" if record["files"] else ""}

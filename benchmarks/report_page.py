# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a report: tables, plots, and a row of pictures per mesh, in one file that needs no other."""

from __future__ import annotations

import html
import io
from pathlib import Path

import matplotlib as mpl

mpl.use("svg")
import matplotlib.pyplot as plt
import numpy as np
from like_colors import like_colors
from scores import MEASURES, labels_path, mean, typical

from core.mesh.triangles import TriMesh
from core.uses.pictures import picture, png, png_address

mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "report", "font.size": 9, "axes.spines.top": False,
                     "axes.spines.right": False, "font.family": "sans-serif"})
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#333333")

STYLE = """
body { font: 14px/1.4 system-ui, sans-serif; margin: 2em auto; max-width: 1200px; padding: 0 1em; color: #222 }
table { border-collapse: collapse; margin: .6em 0 } td, th { padding: .2em .6em; text-align: right }
th { border-bottom: 1px solid #888; font-weight: 600 } td:first-child, th:first-child { text-align: left }
tr:nth-child(even) td { background: #f6f6f6 } .best { font-weight: 700 } svg { max-width: 100%; height: auto }
#bar { position: sticky; top: 0; background: #fff; padding: .6em 0; border-bottom: 1px solid #ccc; z-index: 1 }
#meshes td { vertical-align: top; text-align: center; font-size: 12px } #meshes td:first-child { text-align: left }
#meshes img { display: block; margin: 0 auto }
button { font: inherit; padding: .2em .8em } button[aria-pressed=true] { background: #0072b2; color: #fff }
"""

SCRIPT = """
const body = document.querySelector('#meshes tbody'), rows = [...body.rows];
const method = document.querySelector('#method'), buttons = [...document.querySelectorAll('#bar button')];
let key = 'category';
function value(row) {
  if (key === 'category') return [row.dataset.category, Number(row.dataset.mesh)];
  const number = Number(JSON.parse(row.dataset[key])[method.selectedIndex]);
  return [key === 'error' ? -number : number, Number(row.dataset.mesh)];
}
function sort() {
  const of = new Map(rows.map(row => [row, value(row)]));
  rows.sort((a, b) => {
    const [x, i] = of.get(a), [y, j] = of.get(b);
    return x < y ? -1 : x > y ? 1 : i - j;
  });
  body.append(...rows);
  buttons.forEach(button => button.setAttribute('aria-pressed', button.dataset.key === key));
}
buttons.forEach(button => button.addEventListener('click', () => { key = button.dataset.key; sort(); }));
method.addEventListener('change', sort);
sort();
"""


def page(data: Path, out: Path, rows: list[dict]) -> str:
    """The whole page as HTML. rows : as ``report.run`` gives them; out : the folder with the labels."""
    methods = list(dict.fromkeys(row["method"] for row in rows))
    n_meshes = len({row["mesh"] for row in rows})
    figures = "".join(f"<h2>{title}</h2>{svg(figure)}" for title, figure in plots(rows).items())
    options = "".join(f"<option>{html.escape(name)}</option>" for name in methods)
    buttons = "".join(f'<button type="button" data-key="{key}">{text}</button> ' for key, text in (
        ("category", "by category"), ("error", "worst error first"), ("agreement", "worst agreement first")))
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{n_meshes} meshes, {len(methods)} methods</title>
<style>{STYLE}</style></head><body>
<h1>{n_meshes} meshes, {len(methods)} methods</h1>
<p>Errors are means over the people who cut each mesh. "Told" is the same result read at people's median number of
parts. Tables give means over categories; the best of each row is bold.</p>
<h2>Overall</h2>{overall(rows, methods)}
<h2>Agreement (12) by category</h2>{by_category(rows, methods, "agreement")}
<h2>Rand index error by category</h2>{by_category(rows, methods, "error")}
<h2>Rand index error by category, told the number of parts</h2>{by_category(rows, methods, "told_error")}
{figures}
<h2>Every mesh</h2>
<p>First what the most typical person drew, then each method: Rand index error, agreement, parts.</p>
<div id="bar">Sort {buttons} of <select id="method">{options}</select></div>
<table id="meshes"><thead><tr><th>mesh</th><th>a person</th>{"".join(f"<th>{html.escape(m)}</th>" for m in methods)}
</tr></thead><tbody>
{"".join(mesh_row(data, out, number, rows, methods) for number in dict.fromkeys(row["mesh"] for row in rows))}
</tbody></table>
<script>{SCRIPT}</script></body></html>
"""


def category_means(rows: list[dict], method: str, name: str) -> dict[str, float]:
    """Mean of a column over the meshes of each category."""
    groups: dict[str, list] = {}
    for row in rows:
        if row["method"] == method:
            groups.setdefault(row["category"], []).append(row[name])
    return {category: mean(values) for category, values in groups.items()}


def table(head: list[str], lines: list[tuple[str, list[float], bool]], form: str = ".3f") -> str:
    """A table whose lines have a name, numbers, and whether more is better (None: neither)."""
    cells = []
    for name, values, more in lines:
        finite = [v for v in values if np.isfinite(v)]
        best = None if more is None or not finite else max(finite) if more else min(finite)
        cells.append(f"<tr><td>{html.escape(name)}</td>" + "".join(
            f'<td{" class=best" if value == best else ""}>{format(value, form) if np.isfinite(value) else "-"}</td>'
            for value in values) + "</tr>")
    return f"<table><tr>{''.join(f'<th>{html.escape(h)}</th>' for h in head)}</tr>{''.join(cells)}</table>"


def overall(rows: list[dict], methods: list[str]) -> str:
    """Table of all measures, the mean over categories."""
    def means(name: str) -> list[float]:
        return [mean(category_means(rows, method, name).values()) for method in methods]

    lines = [(title, means(name), more) for name, (title, more) in MEASURES.items()]
    lines += [(f"told: {title}", means(f"told_{name}"), more) for name, (title, more) in MEASURES.items()
              if name in ("error", "agreement", "hamming")]
    lines += [("parts (people " + f"{mean(category_means(rows, methods[0], 'people').values()):.1f})", means("parts"),
               None), ("seconds", means("seconds"), False)]
    return table(["", *methods], lines)


def by_category(rows: list[dict], methods: list[str], name: str) -> str:
    """Table of one measure by category."""
    of_method = [category_means(rows, method, name) for method in methods]
    more = MEASURES[name.removeprefix("told_")][1]
    lines = [(category, [values.get(category, float("nan")) for values in of_method], more)
             for category in of_method[0]]
    lines.append(("mean", [mean(values.values()) for values in of_method], more))
    return table(["category", *methods], lines)


def plots(rows: list[dict]) -> dict[str, plt.Figure]:
    """Agreement by category, parts against people's number, seconds against vertices."""
    methods = list(dict.fromkeys(row["method"] for row in rows))
    return {"Agreement by category": agreement_plot(rows, methods),
            "Parts, and the number that people gave": parts_plot(rows, methods),
            "Seconds, and the number of vertices": seconds_plot(rows, methods)}


def agreement_plot(rows: list[dict], methods: list[str]) -> plt.Figure:
    """Bars of the agreement of each method in each category."""
    figure, axes = plt.subplots(figsize=(10, 3.2), layout="constrained")
    categories = list(dict.fromkeys(row["category"] for row in rows))
    width = 0.8 / len(methods)
    for index, method in enumerate(methods):
        values = category_means(rows, method, "agreement")
        at = np.arange(len(categories)) + (index - (len(methods) - 1) / 2) * width
        axes.bar(at, [values.get(c, np.nan) for c in categories], width, label=method, color=COLORS[index % 7])
    axes.set_xticks(np.arange(len(categories)), categories, rotation=45, ha="right")
    axes.set_ylim(0, 1)
    axes.set_ylabel("agreement (12)")
    axes.legend(ncols=len(methods), frameon=False, loc="upper center", bbox_to_anchor=(0.5, 1.15))
    return figure


def parts_plot(rows: list[dict], methods: list[str]) -> plt.Figure:
    """Number of parts of each mesh over the people's median number, a panel per method."""
    figure, panels = plt.subplots(1, len(methods), figsize=(2.5 * len(methods), 2.8), layout="constrained",
                                  sharex=True, sharey=True, squeeze=False)
    for index, (axes, method) in enumerate(zip(panels[0], methods, strict=True)):
        mine = [row for row in rows if row["method"] == method]
        axes.plot([1, 40], [1, 40], color="#aaa", linewidth=1)
        axes.plot([row["people"] for row in mine], [row["parts"] for row in mine], "o", markersize=3, alpha=0.6,
                  color=COLORS[index % 7])
        axes.set(title=method, xlabel="people", xscale="log", yscale="log")
        axes.set_xticks([1, 2, 5, 10, 20, 40], [1, 2, 5, 10, 20, 40])
        axes.set_yticks([1, 2, 5, 10, 20, 40], [1, 2, 5, 10, 20, 40])
        axes.minorticks_off()
    panels[0, 0].set_ylabel("parts")
    return figure


def seconds_plot(rows: list[dict], methods: list[str]) -> plt.Figure:
    """Seconds of processor time of each run over the number of vertices."""
    figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
    for index, method in enumerate(methods):
        mine = [row for row in rows if row["method"] == method and row["seconds"]]
        axes.plot([row["vertices"] for row in mine], [row["seconds"] for row in mine], "o", markersize=3, alpha=0.6,
                  label=method, color=COLORS[index % 7])
    axes.set(xlabel="vertices", ylabel="seconds", xscale="log", yscale="log")
    axes.legend(frameon=False)
    return figure


def svg(figure: plt.Figure) -> str:
    """A figure as SVG for a page; it is closed."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    return text.getvalue().partition("<svg")[1] + text.getvalue().partition("<svg")[2]


def mesh_row(data: Path, out: Path, number: int, rows: list[dict], methods: list[str]) -> str:
    """The row of a mesh: a person's cut, then each method's, with its figures."""
    with np.load(data / f"{number}.npz") as stored:
        mesh, people = TriMesh(stored["vertices"], stored["faces"]), stored["human"].astype(np.int64)
    person = np.unique(people[typical(people)], return_inverse=True)[1].reshape(-1)
    mine = {row["method"]: row for row in rows if row["mesh"] == number}
    first = next(iter(mine.values()))
    cells = [f"<td>{number}<br>{first['category']}</td>",
             f"<td>{image(mesh, person, person)}{len(np.unique(person))} parts</td>"]
    for method in methods:
        if method not in mine:
            cells.append("<td></td>")
            continue
        row, labels = mine[method], np.load(labels_path(out, method, number)).astype(np.int64)
        figures = f"{row['error']:.3f}, {row['agreement']:.2f}, {row['parts']}"
        cells.append(f"<td>{image(mesh, labels, person)}{figures}</td>")
    keys = "".join(f" data-{key}='{[mine[m][key] if m in mine else 0 for m in methods]}'" for key in (
        "error", "agreement"))
    return f'<tr data-mesh="{number}" data-category="{first["category"]}"{keys}>{"".join(cells)}</tr>\n'


def image(mesh: TriMesh, labels: np.ndarray, reference: np.ndarray) -> str:
    """A picture of parts as an element of the page."""
    data = png(picture(mesh, like_colors(labels, reference, mesh.face_area)))
    return f'<img alt="" width="112" height="112" src="{png_address(data)}">'

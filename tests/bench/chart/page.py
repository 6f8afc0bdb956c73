# SPDX-License-Identifier: MIT
"""The page with all charts: one file that needs nothing else."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from html import escape

STYLE = """
body { font: 15px/1.5 system-ui, "DejaVu Sans", Verdana, sans-serif; color: #222; margin: 0 auto; max-width: 1180px;
  padding: 0 16px 60px; }
h1 { font-size: 26px; margin: 28px 0 4px; } h2 { font-size: 20px; margin: 44px 0 6px; border-top: 2px solid #0072b2;
  padding-top: 14px; } h3 { font-size: 16px; margin: 26px 0 2px; }
nav a { margin-right: 14px; } a { color: #0072b2; }
figure { margin: 6px 0 4px; } figure svg { width: 100%; height: auto; }
figcaption { color: #444; font-size: 13.5px; max-width: 95ch; }
details { margin: 6px 0 14px; } summary { cursor: pointer; color: #0072b2; font-size: 14px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 12.5px; margin: 6px 0; } caption { text-align: left; color: #444; }
th, td { padding: 2px 9px; text-align: right; border-bottom: 1px solid #e6e6e6; white-space: nowrap; }
th { background: #f4f6f8; cursor: pointer; position: sticky; top: 0; } th:hover { background: #e3e9ee; }
td.t, th.t { text-align: left; } td.w { white-space: normal; min-width: 50ch; } tr.front td { background: #eef6ee; }
code, pre { background: #f4f6f8; padding: 1px 4px; font-size: 13px; } pre { padding: 8px 10px; overflow-x: auto; }
li { margin: 2px 0; }
"""

# Sorts a table by the column that is clicked, by numbers where all its cells have them.
SCRIPT = """
document.querySelectorAll('th').forEach(function (head) {
  head.addEventListener('click', function () {
    var table = head.closest('table'), body = table.tBodies[0], column = head.cellIndex;
    var key = function (row) { return row.cells[column].dataset.n || row.cells[column].textContent; };
    var rows = Array.from(body.rows), down = head.dataset.down !== '1';
    rows.sort(function (a, b) {
      var x = key(a), y = key(b), p = parseFloat(x), q = parseFloat(y);
      if (x === '' || y === '') { return (x === '') - (y === ''); }
      return (down ? 1 : -1) * (isNaN(p) || isNaN(q) ? x.localeCompare(y) : p - q);
    });
    head.dataset.down = down ? '1' : '0';
    rows.forEach(function (row) { body.appendChild(row); });
  });
});
"""


@dataclass
class Table:
    """Columns and cells: texts, or numbers (NaN is empty). marked: rows to tell apart."""

    columns: Sequence[str]
    cells: Sequence[Sequence[str | float]]
    marked: set[int] = field(default_factory=set)


def number(value: float) -> str:
    """Three digits, with a power of ten where it needs one."""
    if math.isnan(value):
        return ""
    if value == 0 or 0.01 <= abs(value) < 1e6:
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    return f"{value:.2e}"


def _cell(value: str | float) -> str:
    if isinstance(value, str):
        return f'<td class="{"t w" if len(value) > 60 else "t"}">{escape(value)}</td>'
    plain = "" if math.isnan(value) else repr(float(value))
    return f'<td data-n="{plain}">{number(value)}</td>'


def table(data: Table) -> str:
    kinds = [bool(data.cells) and isinstance(data.cells[0][i], str) for i in range(len(data.columns))]
    heads = "".join(f'<th{" class=t" if kind else ""}>{escape(name)}</th>' for name, kind in zip(data.columns, kinds))
    rows = []
    for i, line in enumerate(data.cells):
        mark = ' class="front"' if i in data.marked else ""
        rows.append(f"<tr{mark}>{''.join(_cell(value) for value in line)}</tr>")
    body = "\n".join(rows)
    return f'<div class="scroll"><table><thead><tr>{heads}</tr></thead><tbody>\n{body}\n</tbody></table></div>'


def folded(summary: str, inner: str) -> str:
    return f"<details><summary>{escape(summary)}</summary>\n{inner}\n</details>"


def inline(svg: str) -> str:
    """The picture without what only a file of its own needs."""
    return svg[svg.index("<svg") :]


def figure(title: str, svg: str, caption: str, data: Table) -> str:
    return (
        f"<h3>{escape(title)}</h3>\n<figure>{inline(svg)}\n<figcaption>{escape(caption)}</figcaption></figure>\n"
        + folded(f"Table: {len(data.cells)} rows", table(data))
    )


def bullets(items: Iterable[str]) -> str:
    return "<ul>\n" + "\n".join(f"<li>{escape(item)}</li>" for item in items) + "\n</ul>"


def page(title: str, lead: str, sections: Sequence[tuple[str, str, str]]) -> str:
    """lead: HTML. sections: anchor, title, HTML."""
    links = " ".join(f'<a href="#{anchor}">{escape(name)}</a>' for anchor, name, _ in sections)
    bodies = "\n".join(f'<h2 id="{anchor}">{escape(name)}</h2>\n{body}' for anchor, name, body in sections)
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>\n'
        f"<style>{STYLE}</style></head>\n<body>\n<h1>{escape(title)}</h1>\n{lead}\n<nav>{links}</nav>\n{bodies}\n"
        f"<script>{SCRIPT}</script>\n</body></html>\n"
    )

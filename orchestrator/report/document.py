"""The HTML around a page: one file with its look, its data, its script, and the plotting library."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from orchestrator.report.encode import squeezed, to_json
from orchestrator.report.html import Markup, joined, tag, void
from orchestrator.report.library import require_library
from orchestrator.report.panels.panel import Panel

_HERE = Path(__file__).parent


def document(title: str, body: str, panels: Mapping[str, Panel]) -> str:
    """The text of a page.

    Parameters
    ----------
    title : str
        For the browser.
    body : str
        With a box for each panel.
    panels : mapping
        Figures by the id of their box.
    """
    content = to_json({key: panel.data() for key, panel in panels.items()})
    parts = [
        "<!doctype html>",
        '<html lang="en">',
        joined([
            Markup("<head>"),
            void("meta", charset="utf-8"),
            void("meta", name="viewport", content="width=device-width, initial-scale=1"),
            tag("title", f"{title} - bladeloss"),
            Markup(f"<style>{(_HERE / 'page.css').read_text(encoding='utf-8')}</style>"),
            Markup("</head>"),
        ]),
        tag("body", body,
            Markup(f'<script type="text/plain" id="data">{squeezed(content)}</script>'),
            Markup(f'<script type="text/plain" id="library">{squeezed(require_library()())}</script>'),
            Markup(f"<script>{(_HERE / 'page.js').read_text(encoding='utf-8')}</script>")),
        "</html>",
    ]  # fmt: skip
    return "\n".join(parts) + "\n"

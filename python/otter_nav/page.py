"""A self-contained HTML page: sections of pictures and tables, light, dark and on paper."""
import html

from .svg import palette

_CSS = """
:root{color-scheme:light dark;--font:system-ui,-apple-system,"Segoe UI","DejaVu Sans",sans-serif;
LIGHT}
@media (prefers-color-scheme:dark){:root{DARK}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--fg);font:15px/1.5 var(--font)}
main{max-width:1000px;margin:0 auto;padding:28px 24px 60px}
h1{font-size:25px;line-height:1.25;margin:0 0 4px}
h2{font-size:18px;margin:38px 0 8px;padding-top:14px;border-top:1px solid var(--grid)}
p{margin:6px 0;max-width:72ch}
.lead,.note,figcaption{color:var(--muted)}
.note,figcaption{font-size:13px}
.badge{display:inline-block;padding:1px 10px;border:1.5px solid currentColor;border-radius:12px;
font-size:14px;font-weight:600;vertical-align:middle;margin-left:8px}
.good{color:var(--reference)}.bad{color:var(--left)}
.figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(150px,1fr));gap:10px;
margin:20px 0 0;padding:0}
.figures div{border:1px solid var(--grid);border-radius:8px;padding:8px 12px}
.figures dt{font-size:12.5px;color:var(--muted)}
.figures dd{margin:0;font-size:19px;font-weight:600;font-variant-numeric:tabular-nums}
.figures small{font-size:13px;font-weight:400}
figure{margin:10px 0 16px;break-inside:avoid}
figure svg{width:100%;height:auto;display:block}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(400px,1fr));gap:6px 20px}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:13.5px;font-variant-numeric:tabular-nums;
margin:8px 0}
th,td{padding:4px 10px 4px 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--grid)}
th{color:var(--muted);font-weight:600}
td.number,th.number{text-align:right}td.number{white-space:nowrap}
th{vertical-align:bottom;line-height:1.25}td.long{overflow-wrap:break-word}
tr{break-inside:avoid}
pre{white-space:pre-wrap;font-size:12.5px}
@media (max-width:480px){.pair{grid-template-columns:1fr}}
@media print{:root{color-scheme:light;LIGHT}@page{margin:14mm}body{font-size:11pt}
main{max-width:none;padding:0}h2,h2+.note{break-after:avoid}h2{margin-top:14px}
.scroll{overflow:visible}figure svg{max-height:125mm}pre{columns:2;font-size:8pt}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
"""


def escape(text):
    return html.escape(str(text))


def number(value, digits=3):
    """A number as a reader wants it; a dash for none."""
    if value is None or value != value:
        return "–"
    if isinstance(value, str):
        return escape(value)
    if isinstance(value, int) and not isinstance(value, bool):
        return str(value)
    if 0.0 < abs(value) < 2.0 * 10.0**-digits:
        digits += 2
    return f"{value:.{digits}f}"


class Page:
    def __init__(self, title):
        self.title = title
        self._parts = []

    def raw(self, text):
        self._parts.append(text)

    def heading(self, text, lead="", badge="", good=True):
        kind = "good" if good else "bad"
        shown = f'<span class="badge {kind}">{escape(badge)}</span>' if badge else ""
        self.raw(f"<h1>{escape(text)}{shown}</h1>")
        if lead:
            self.raw(f'<p class="lead">{escape(lead)}</p>')

    def section(self, title, note=""):
        self.raw(f"<h2>{escape(title)}</h2>")
        if note:
            self.raw(f'<p class="note">{escape(note)}</p>')

    def figures(self, entries):
        """(name, shown value, unit) each."""
        cells = "".join(f"<div><dt>{escape(name)}</dt><dd>{value} "
                        f"<small>{escape(unit)}</small></dd></div>" for name, value, unit in entries)
        self.raw(f'<dl class="figures">{cells}</dl>')

    def picture(self, svg, caption=""):
        if svg:
            words = f"<figcaption>{escape(caption)}</figcaption>" if caption else ""
            self.raw(f"<figure>{svg}{words}</figure>")

    def pictures(self, svgs, captions=()):
        """Side by side, each with its caption above it."""
        words = list(captions) + [""] * (len(svgs) - len(captions))
        shown = [f"<figure>{f'<figcaption>{escape(w)}</figcaption>' if w else ''}{svg}</figure>"
                 for svg, w in zip(svgs, words) if svg]
        if shown:
            self.raw(f'<div class="pair">{"".join(shown)}</div>')

    def table(self, head, rows, numbers=()):
        """`numbers`: the columns set as numbers, to the right."""
        def cell(tag, k, text):
            kind = ' class="number"' if k in numbers else ' class="long"' if tag == "td" else ""
            return f"<{tag}{kind}>{escape(text)}</{tag}>"
        top = "".join(cell("th", k, text) for k, text in enumerate(head))
        body = "".join("<tr>" + "".join(cell("td", k, text) for k, text in enumerate(row)) + "</tr>"
                       for row in rows)
        self.raw(f'<div class="scroll"><table><thead><tr>{top}</tr></thead>'
                 f"<tbody>{body}</tbody></table></div>")

    def html(self):
        css = _CSS.replace("LIGHT", palette(1)).replace("DARK", palette(2)).strip()
        body = "\n".join(self._parts)
        return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
                f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
                f"<title>{escape(self.title)}</title>\n<style>\n{css}\n</style>\n</head>\n"
                f"<body>\n<main>\n{body}\n</main>\n</body>\n</html>\n")

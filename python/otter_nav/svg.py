"""Pictures as inline SVG that follow the page's light or dark look.

Pictures are drawn in stand-in colours, one for each role. In the SVG these become CSS variables,
which the page sets for light and dark.
"""
import io
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as pyplot  # noqa: E402

SPEED_STEPS = 10
# role: (stand-in, light, dark). Data in Okabe and Ito's colours, lightened for the dark.
_ROLES = {
    "fg": ("#010203", "#1c2126", "#e4e8ec"),
    "muted": ("#010204", "#5b646e", "#a3adb8"),
    "grid": ("#010205", "#dde2e7", "#343b43"),
    "water": ("#010206", "#eaf2f7", "#18242d"),
    "left": ("#010208", "#d55e00", "#ff8f45"),
    "right": ("#010209", "#0072b2", "#56b4e9"),
    "reference": ("#01020a", "#007a59", "#2cc9a0"),
    "accent": ("#01020b", "#b37400", "#f0b429"),
    "third": ("#01020c", "#a3487f", "#e08dbb"),
    "limit": ("#01020d", "#5b646e", "#a3adb8"),
    "shade": ("#01020e", "#e69f00", "#e69f00"),
    "page": ("#01020f", "#ffffff", "#12171c"),
}


def _viridis(low, high):
    shades = matplotlib.colormaps["viridis"]
    return [matplotlib.colors.to_hex(shades(low + (high - low) * k / (SPEED_STEPS - 1)))
            for k in range(SPEED_STEPS)]


for _k, (_light, _dark) in enumerate(zip(_viridis(0.0, 0.9), _viridis(0.28, 1.0))):
    _ROLES[f"speed{_k}"] = (f"#0103{_k:02x}", _light, _dark)

COLOUR = {role: stand_in for role, (stand_in, _, _) in _ROLES.items()}


def palette(column):
    """The CSS variables of the light (1) or the dark (2) look."""
    return "".join(f"--{role}:{entry[column]};" for role, entry in _ROLES.items())


_STYLE = {
    "svg.fonttype": "none", "svg.hashsalt": "otter_nav", "font.family": "sans-serif",
    "font.size": 9.5, "axes.titlesize": 10.5, "axes.titlelocation": "left",
    "text.color": COLOUR["fg"], "axes.labelcolor": COLOUR["fg"], "axes.edgecolor": COLOUR["muted"],
    "axes.titlecolor": COLOUR["fg"], "xtick.color": COLOUR["muted"],
    "xtick.labelcolor": COLOUR["fg"], "ytick.color": COLOUR["muted"],
    "ytick.labelcolor": COLOUR["fg"], "grid.color": COLOUR["grid"], "axes.grid": True,
    "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False,
    "axes.facecolor": "none", "figure.facecolor": "none", "savefig.facecolor": "none",
    "legend.frameon": False, "legend.fontsize": 9, "lines.linewidth": 1.4, "path.simplify": True,
    "path.simplify_threshold": 0.3, "figure.constrained_layout.use": True,
}


def styled():
    return matplotlib.rc_context(_STYLE)


_count = 0


def to_svg(figure, description):
    """The figure as an <svg> to stand in a page: text as text, colours as variables."""
    global _count
    _count += 1
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    pyplot.close(figure)
    text = buffer.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    prefix = f"f{_count}-"
    text = re.sub(r'\bid="', f'id="{prefix}', text)
    text = re.sub(r'href="#', f'href="#{prefix}', text)
    text = re.sub(r"url\(#", f"url(#{prefix}", text)
    for role, (stand_in, _, _) in _ROLES.items():
        text = text.replace(stand_in, f"var(--{role})")
    text = re.sub(r"font: ([\d.]+)px [^;\"]*", r"font: \1px var(--font)", text)
    text = re.sub(r'<svg ([^>]*?)width="[^"]*"', r"<svg \1", text, count=1)
    text = re.sub(r'<svg ([^>]*?)height="[^"]*"', r"<svg \1", text, count=1)
    label = _escape(description)
    text = text.replace("<svg ", f'<svg role="img" aria-label="{label}" ', 1)
    head = text.index(">") + 1
    return text[:head] + f"<title>{label}</title>" + text[head:].rstrip()


def _escape(text):
    return (text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
            .replace('"', "&quot;"))

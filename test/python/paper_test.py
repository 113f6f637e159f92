"""docs/paper.md names places that are there."""
import re
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
ROW = re.compile(r"^\| (?P<place>[^|]+) \| [^|]+ \| `(?P<file>[^`]+)` \| (?P<names>.+) \|$")


def rows():
    text = (TOP / "docs" / "paper.md").read_text()
    return [match for match in map(ROW.match, text.splitlines()) if match]


def test_every_equation_and_algorithm_has_a_row():
    places = " ".join(row["place"] for row in rows())
    for number in range(1, 20):
        assert re.search(rf"equations?\b[^|]*\b{number}\b", places), f"equation {number}"
    for word in ("algorithm 1", "algorithm 2", "table I", "table II", "III-A", "III-B", "IV-A", "IV-B", "V-A", "V-B"):
        assert word in places, word


def test_files_and_functions_exist():
    assert len(rows()) > 30
    for row in rows():
        path = TOP / row["file"]
        assert path.is_file(), row["file"]
        text = path.read_text()
        for name in re.findall(r"`([^`]+)`", row["names"]):
            assert re.search(rf"\b{re.escape(name)}\b", text), f"{row['file']}: {name}"

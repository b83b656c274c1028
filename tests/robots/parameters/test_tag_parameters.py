"""Parameters of SDF tags: what is wrong with one is named with its line, and the default is used."""

import math

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.robots.parameters import ParamError, TagParameters


def read(text: str) -> TagParameters:
    return TagParameters(parse_xml(f"<plugin>\n{text}\n</plugin>", name="m.sdf"), Diagnostics())


def test_values_are_read_as_they_are_written() -> None:
    parameters = read("<a>1.5</a><b>0x10</b><c>True</c><d> text </d><e>1 2 3</e><f>x</f><f>y</f>")

    assert parameters.number("a") == 1.5
    assert parameters.integer("b") == 16
    assert parameters.flag("c", default=False) is True
    assert parameters.text("d") == "text"
    assert parameters.vector("e") == (1.0, 2.0, 3.0)
    assert parameters.texts("f") == ["x", "y"]
    assert parameters.number("z", math.inf) == math.inf
    assert parameters.report.findings == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("fast", "<x>: 'fast' is not a number; 5 is used"),
        ("", "<x>: '' is not a number; 5 is used"),
        ("nan", "<x>: 'nan' is not a finite number; 5 is used"),
        ("-1", "<x> must be ≥ 0, got -1; 5 is used"),
    ],
)
def test_an_invalid_number_is_reported_at_its_line(text: str, message: str) -> None:
    parameters = read(f"<x>{text}</x>")

    assert parameters.number("x", 5.0, minimum=0.0) == 5.0
    assert parameters.report.warnings == [f"m.sdf:2: warning: {message}"]


def test_other_invalid_values_are_reported() -> None:
    parameters = read("<flag>maybe</flag><vector>1 2</vector><rate>0</rate>")

    assert parameters.flag("flag", default=True)
    assert parameters.vector("vector", (0.0, 0.0, 1.0)) == (0.0, 0.0, 1.0)
    assert parameters.number("rate", 30.0, above=0.0) == 30.0
    assert [finding.what for finding in parameters.report.findings] == [
        "<flag>: 'maybe' is neither true nor false; true is used",
        "<vector>: '1 2' is not 3 numbers; 0 0 1 is used",
        "<rate> must be > 0, got 0; 30 is used",
    ]


@pytest.mark.parametrize("text", ["", "<link/>", "<link></link>"])
def test_a_required_parameter_that_is_absent_or_empty_is_an_error(text: str) -> None:
    with pytest.raises(ParamError, match=r"^<link> is missing$"):
        read(text).text("link")


def test_an_invalid_required_parameter_is_an_error() -> None:
    with pytest.raises(ParamError, match=r"^<radius> must be > 0, got -1$"):
        read("<radius>-1</radius>").number("radius", above=0.0)


def test_sections_have_parameters_of_their_own() -> None:
    parameters = read("<wheel name='l'><r>1</r></wheel>\n<wheel name='r'><r>bad</r></wheel>")

    assert [wheel.attribute("name") for wheel in parameters.sections("wheel")] == ["l", "r"]
    assert [wheel.number("r", 2.0) for wheel in parameters.sections("wheel")] == [1.0, 2.0]
    assert parameters.report.warnings == ["m.sdf:3: warning: <r>: 'bad' is not a number; 2 is used"]
    assert parameters.section("absent").section("more").number("r", 3.0) == 3.0
    assert "wheel" in parameters
    assert "absent" not in parameters


def test_unread_parameters_are_reported() -> None:
    parameters = read("<a>1</a><b>2</b><c>0</c><d>3</d><e>4</e>")
    parameters.number("a")
    parameters.ignore("b")
    parameters.warn_unsupported("c", "d")
    parameters.report_unread()

    assert [finding.what for finding in parameters.report.findings] == [
        "<d> is not supported",
        "<e> in <plugin> is not supported; it is ignored",
    ]

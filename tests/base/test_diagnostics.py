"""Findings as printed."""

import io

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError, colored


def test_a_message_on_many_lines_is_printed_once_worst_first() -> None:
    report = Diagnostics()
    for line in (7, 9, 11, 13, 15):
        report.info(Source("a.urdf", line), "grey")
    report.info(Source("b.urdf", 9), "grey")
    for line in (20, 30):
        report.warn(Source("a.urdf", line), "lost")
    report.info(Source("c.urdf"), "grey")

    assert report.worst_first() == [
        "a.urdf:20: warning: lost (also on line 30)",
        "a.urdf:7: info: grey (also on lines 9, 11, 13 and 1 more)",
        "b.urdf:9: info: grey",
        "c.urdf: info: grey",
    ]
    assert len(report.findings) == 9


def test_an_error_with_further_errors_adds_one_finding_each() -> None:
    report = Diagnostics()
    error = DescriptionError(
        Source("a.launch", 2), "no package 'a'", more=[DescriptionError(Source("b.launch", 7), "no package 'b'")]
    )

    report.error(error)

    messages = ["a.launch:2: error: no package 'a'", "b.launch:7: error: no package 'b'"]
    assert report.errors == messages == str(error).splitlines()


def test_a_recovered_error_becomes_a_warning_at_its_own_source() -> None:
    """The warning names the position and the severity once."""
    report = Diagnostics()

    report.warn_error(DescriptionError(Source("b.urdf", 3), "no mesh"), Source("a.urdf", 1), "it is left out", "mesh")
    report.warn_error(UsageError("no joint"), Source("a.urdf", 1), "it is left out", "mesh", subject="plugin 'p'")

    assert report.warnings == [
        "b.urdf:3: warning: no mesh; it is left out",
        "a.urdf:1: warning: plugin 'p': no joint; it is left out",
    ]


def test_control_characters_in_names_are_escaped() -> None:
    name = "a\nx.sdf:1: error: forged\x1b[2J\x9b2J\u202e é"
    report = Diagnostics()
    report.warn(Source("x\n.sdf", 2), f"no model {name}")
    error = DescriptionError(Source("x.sdf", 1), f"no model {name}")

    escaped = r"no model a\nx.sdf:1: error: forged\x1b[2J\x9b2J\u202e é"
    assert report.warnings == [rf"x\n.sdf:2: warning: {escaped}"]
    assert str(error) == f"x.sdf:1: error: {escaped}"


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_severities_are_colored_only_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    text = "a.sdf:3: warning: no mass\na.sdf: a model; 1 warning: none\ntrundle: error: no\n"

    assert colored(text, io.StringIO()) == text
    assert colored(text, _Terminal()).split("\n")[:3] == [
        "a.sdf:3: \033[1;33mwarning:\033[0m no mass",
        "a.sdf: a model; 1 warning: none",
        "trundle: \033[1;31merror:\033[0m no",
    ]
    monkeypatch.setenv("NO_COLOR", "1")
    assert colored(text, _Terminal()) == text

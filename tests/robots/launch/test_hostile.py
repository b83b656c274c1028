"""Reading any launch file gives a plan or an error."""

import contextlib
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.launch import LaunchPlan, read_launch, read_launch_text


class OnePackage:
    """Package finder that returns the same folder for every name."""

    def find_folder(self, name: str, /) -> Path | None:
        return Path(__file__).parent if name == "p" else None

    is_lenient = False

    def absent_package(self, _file: Path, /) -> str | None:
        return None

    def not_found_message(self, name: str, /) -> str:
        return f"no package {name!r}"


_VALUES = st.sampled_from(
    """true|false|1|0||abc|/a/b|~x|a/b|$(arg a)|$(eval 1+1)|$(find p)/x|$(anon x)|$(env HOME)|$(optenv A b c)|$()|$(
    $(arg)|$(arg a b)|1e400|[1,2]|{a: b}|!!binary aGk=|!!set {a}|{1: 2}|{[1]: 2}|<<: 1|? a|2001-13-45|!degrees x|rad(x)
    deg()|/dev/null|/|yaml|load|dump|delete|$(eval [].append(1))|$(eval "9"*9**9)|$(eval 9**9999)|$(eval {}[1])
    $(eval "x"[::0])|$(eval map(float, "x"))|$(eval arg(1))|$(eval find([]))|$(eval f"{a}")|$(eval a.b)|$(eval 1<<99)
    """.replace("\n", "|").split("|")
) | st.text(max_size=30)

_ATTRIBUTE_NAMES = """name value type command file param ns if unless pkg args default textfile from to subst_value
    output cwd respawn required respawn_delay clear_params pass_all_args launch-prefix machine doc"""
_TAG_NAMES = "node test param rosparam arg group include remap env machine master x"
_ATTRIBUTES = st.dictionaries(st.sampled_from(_ATTRIBUTE_NAMES.split()), _VALUES, max_size=6)
_TAGS = st.sampled_from(_TAG_NAMES.split())


def _escaped(text: str) -> str:
    text = "".join(c for c in text if c.isprintable() and not "\ud800" <= c <= "\udfff" and c not in "\ufffe\uffff")
    return text.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")


@st.composite
def _elements(draw: st.DrawFn, depth: int = 0) -> str:
    tag = draw(_TAGS)
    attributes = "".join(f' {key}="{_escaped(value)}"' for key, value in draw(_ATTRIBUTES).items())
    children = "".join(draw(st.lists(_elements(depth + 1), max_size=3))) if depth < 2 else ""
    return f"<{tag}{attributes}>{_escaped(draw(_VALUES))}{children}</{tag}>"


@given(st.lists(_elements(), max_size=5))
@settings(max_examples=150)
def test_any_file_becomes_a_plan_or_an_error(elements: list[str]) -> None:
    text = f'<launch><arg name="a" default="1"/>{"".join(elements)}</launch>'
    with contextlib.suppress(DescriptionError):
        read_launch_text(text, name="t.launch", packages=OnePackage(), report=Diagnostics(), env={"HOME": "/h"})


@pytest.mark.parametrize(
    "body",
    [
        '<param name="a" value="$(eval 9**9999)"/>',
        f'<param name="a" textfile="{"x" * 5000}"/>',
        f'<include file="{"x" * 5000}"/>',
        f'<rosparam file="{"x" * 5000}"/>',
        '<param name="a" type="int" value="' + "9" * 5000 + '"/>',
        "<rosparam>" + "9" * 5000 + "</rosparam>",
        '<rosparam file="/dev/zero"/>',
    ],
)
def test_expressions_that_python_refuses_are_refused_with_an_error(body: str) -> None:
    with pytest.raises(DescriptionError, match=r"t\.launch:1: error: "):
        read_launch_text(f"<launch>{body}</launch>", name="t.launch", packages=OnePackage(), report=Diagnostics())


def read(body: str) -> LaunchPlan:
    return read_launch_text(f"<launch>{body}</launch>", name="t", packages=OnePackage(), report=Diagnostics())


def test_a_file_that_includes_itself_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "again.launch"
    file.write_text(f'<launch><include file="{file}"/></launch>')
    with pytest.raises(DescriptionError, match="it may include itself"):
        read_launch(file, packages=OnePackage(), report=Diagnostics())


def test_yaml_of_a_few_lines_that_stands_for_billions_of_values_is_refused() -> None:
    lines = ["a0: &amp;a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &amp;a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 10)]
    with pytest.raises(DescriptionError, match="aliases stand for more than"):
        read("<rosparam>\n" + "\n".join(lines) + "\n</rosparam>")


def test_yaml_that_contains_itself_is_refused() -> None:
    with pytest.raises(DescriptionError, match="a value contains itself"):
        read("<rosparam>a: &amp;a [*a]</rosparam>")

"""Names in xacro's expressions; hostile files are stopped early, with an error."""

import html
import math
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import expand_xacro
from trundle.robots.packages import Packages


def expand(folder: Path, body: str) -> str:
    file = folder / "x.xacro"
    file.write_text(f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{body}</robot>')
    return expand_xacro(file, {}, packages=Packages({}, start=folder), report=Diagnostics())


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("'%.3f' % sin(math.pi / 2) + str(python.abs(-1))", "1.0001"),
        ("python.sum(list(python.zip([1], [2]))[0]) if pi > 3 else 0", "3"),
        ("xacro.arg('size')", "7"),
        ("xacro.tokenize('a, b;c')", "['a', 'b', 'c']"),
        ("xacro.tokenize('a-b[c', sep='[-')", "['a', 'b', 'c']"),
        ("xacro.dotify(dict(a=dict(b=4))).a.b", "4"),
        ("list(python.enumerate(['x']))", "[(0, 'x')]"),
        ("'_'.join([str(i) for i in python.range(3)])", "0_1_2"),
        ("table['left'][0] + table.get('right', 5)", "6"),
        ("robot.size.x * 2 + robot['size'].y", "7.0"),
        ("[each.name for each in robot.wheels if each.name.startswith('f')]", "['front']"),
        ("robot.turn", str(math.pi / 2)),
        ("double(4) + python.len(names)", "10"),
        ("names[0].rjust(6)", "     a"),
        ("xacro.message('x') + 'y'", "y"),
        ("'a'.__len__()", "1"),
        ("python", "<namespace>"),
    ],
)
def test_expressions_of_published_files_have_their_values(tmp_path: Path, expression: str, value: str) -> None:
    (tmp_path / "robot.yaml").write_text(
        "size: {x: 2.0, y: 3.0}\nwheels: [{name: front}, {name: rear}]\nturn: !degrees 90\n"
    )
    properties = {
        "table": "${dict(left=[1])}",
        "robot": "${xacro.load_yaml('robot.yaml')}",
        "double": "${lambda n: n * factor}",
        "factor": "2",
        "names": "${'a b'.split()}",
    }
    body = "".join(f'<xacro:property name="{name}" value="{text}"/>' for name, text in properties.items())
    body += f'<xacro:arg name="size" default="7"/><a b="{html.escape("${" + expression + "}")}"/>'

    assert f'b="{html.escape(value)}"' in expand(tmp_path, body).replace("&#x27;", "'").replace("'", "&#x27;")


@pytest.mark.parametrize(
    ("expression", "words"),
    [
        ("nothing", "name 'nothing' is not defined"),
        ("xacro.nothing", "name 'nothing' is not defined"),
        ("xacro.parent", "name 'parent' is not defined"),
        ("math.keys()", "name 'keys' is not defined"),
        ("python.vars", "name 'vars' is not defined"),
        ("robot.nothing", "The yaml dictionary has no key 'nothing'; it has 'a'"),
        ("robot['nothing']", "the dictionary has no key 'nothing'; it has 'a'"),
        ("dict([('x', 1), ('y' * 99, 2)])['z']", "the dictionary has no key 'z'; it has 'x', …"),
        (
            "dict([(str(i), i) for i in python.range(9)])[1]",
            "the dictionary has no key 1; it has '0', '1', '2', '3', '4', '5', '6', '7', …",
        ),
        ("dict()['z']", "the dictionary has no key 'z'; it has none"),
        ("dict(a=1).b", "'dict' object has no attribute 'b', nor such a key; it has 'a'"),
        ("dict(a=1).a", "'dict' object has no attribute 'a'; its key is written ['a']"),
        ("xacro.fatal('out', 'of', 3)", "out of 3"),
        ("python.clear()", "name 'clear' is not defined"),
        ("xacro.load_yaml.call", "'Function' object has no attribute 'call' that an expression may use"),
        ("xacro.__class__", "Use of invalid name(s): __class__"),
        ("xacro.tokenize('a' * 40, sep='x]|(a+)+$|[y')", None),
    ],
)
def test_errors_in_expressions_have_xacros_message(tmp_path: Path, expression: str, words: str | None) -> None:
    (tmp_path / "robot.yaml").write_text("a: 1")
    body = '<xacro:property name="robot" value="${xacro.load_yaml(\'robot.yaml\')}"/>'
    body += f'<a b="{html.escape("${" + expression + "}")}"/>'
    if words is None:
        assert expand(tmp_path, body)
        return
    with pytest.raises(DescriptionError) as error:
        expand(tmp_path, body)
    assert f"error: {words} when evaluating expression" in str(error.value)


@pytest.mark.parametrize(
    ("text", "expected"),
    [("sorted([1])", "python.sorted"), ("range(3)", "python.range"), ("dotify(dict())", "xacro.dotify")],
)
def test_names_without_their_namespace_work_with_a_warning(tmp_path: Path, text: str, expected: str) -> None:
    file = tmp_path / "x.xacro"
    file.write_text(f'<r xmlns:xacro="http://www.ros.org/wiki/xacro"><a b="${{{text}}}"/></r>')
    report = Diagnostics()
    expand_xacro(file, {}, packages=Packages({}, start=tmp_path), report=report)
    (warning,) = report.warnings
    assert f"is deprecated. Use {expected}() instead." in warning


@pytest.mark.parametrize(
    "expression",
    [
        "9**9**9",
        "[[0]*1000000 for _ in python.range(400)]",
        "().__class__",
        "__import__('os')",
        "open('/etc/passwd')",
        "python.vars(python.type)",
        "(lambda h: [h.append((h[0].gi_frame for _ in [1])), list(h[0])][1])([])",
        "-" * 60_000 + "1",
        "-" * 100_000 + "1",
        "('a' * 1000000).replace('a', 'a' * 1000000)",
    ],
)
def test_hostile_expressions_are_refused(tmp_path: Path, expression: str) -> None:
    with pytest.raises(DescriptionError) as error:
        expand(tmp_path, f'<link name="${{{expression}}}"/>')
    assert len(str(error.value)) < 1000


def test_an_error_names_the_line_of_its_expression(tmp_path: Path) -> None:
    other = tmp_path / "other.xacro"
    other.write_text('<r xmlns:xacro="http://www.ros.org/wiki/xacro">\n<a\nb="${1 &lt; nothing}"/></r>')
    with pytest.raises(DescriptionError, match=r"other\.xacro:3: error: name 'nothing' is not defined"):
        expand(tmp_path, f'<xacro:include filename="{other}"/>')


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ('<a/>\n<a b="${nothing}" c="${nothing}"/>', "name 'nothing' is not defined"),
        ('<!-- ${nothing} -->\n<a b="${nothing}"/>', "name 'nothing' is not defined"),
        ('<a/>\n<a b="$(arg nothing)"/>', "Undefined substitution argument nothing"),
        ('<a/>\n<xacro:if value="maybe"/>', 'Xacro conditional "maybe"'),
        ("<a/>\n<xacro:nothing/>", "unknown macro name"),
        ("<a/>\n<a><b/>$(find nothing)</a>", "no package 'nothing'"),
        ('<a/>\n<a b="$(find nothing)"/>', "no package 'nothing'"),
        ('<a/>\n<xacro:include filename="$(find nothing)/a.xacro"/>', "no package 'nothing'"),
        ('<a/>\n<xacro:include filename="/usr/secret"/>', "xacro:include leads to /usr/secret; "),
        ('<a/>\n<xacro:include filename="nothing"/>', "no such file '.*/nothing'"),
        (f'<a/>\n<xacro:include filename="{"a" * 300}"/>', r"/a+…: File name too long"),
        ('<xacro:macro name="m">\n<a b="${x}" c="${x}"/></xacro:macro>\n<xacro:m/>', "name 'x' is not defined"),
        ('<xacro:macro name="m" params="x"/>\n<xacro:m/>', r"Undefined parameters \[x\]"),
    ],
)
def test_an_error_names_the_line_of_its_element(tmp_path: Path, body: str, words: str) -> None:
    with pytest.raises(DescriptionError, match=rf"x\.xacro:2: error: .*{words}"):
        expand(tmp_path, body)


def test_an_error_in_a_macro_of_another_file_names_that_file(tmp_path: Path) -> None:
    (tmp_path / "m.xacro").write_text(
        '\n\n<r xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m">\n<a b="${x}" c="${x}"/>'
        "</xacro:macro></r>"
    )
    with pytest.raises(DescriptionError, match=r"m\.xacro:4: error: name 'x' is not defined"):
        expand(tmp_path, '<xacro:include filename="m.xacro"/><xacro:m/>')


def test_a_file_that_is_not_well_formed_is_named_with_the_line(tmp_path: Path) -> None:
    (tmp_path / "m.xacro").write_text("\n<r>\n<a></r>")
    with pytest.raises(
        DescriptionError, match=r"m\.xacro:3: error: not well-formed XML: </r> does not match <a> of line 3"
    ):
        expand(tmp_path, '<xacro:include filename="m.xacro"/>')


@pytest.mark.parametrize(
    ("data", "words"),
    [(b"a: b: c", "line 1, column 5: mapping values are not allowed here"), (b"a: \xe9", "it is not UTF-8 text")],
)
def test_yaml_that_cannot_be_read_is_named(tmp_path: Path, data: bytes, words: str) -> None:
    (tmp_path / "a.yaml").write_bytes(data)
    with pytest.raises(DescriptionError, match=rf"x\.xacro:2: error: .*/a\.yaml: {words} when"):
        expand(tmp_path, "\n<a b=\"${xacro.load_yaml('a.yaml')}\"/>")


def test_eval_substitutions_are_bounded_too(tmp_path: Path) -> None:
    assert 'name="3m"' in expand(tmp_path, "<link name=\"$(eval [str][0:1] and '3' + 'm')\"/>")
    with pytest.raises(DescriptionError, match=r"error: a number of more than 100000 bits \[xacro\]$"):
        expand(tmp_path, '<link name="$(eval 9**9**9)"/>')
    with pytest.raises(DescriptionError, match="name 'exec' is not defined"):
        expand(tmp_path, '<link name="$(eval exec)"/>')
    with pytest.raises(DescriptionError, match="the format '9999999999' is not supported"):
        expand(tmp_path, "<link name=\"$(eval f'{1:9999999999}')\"/>")


def test_a_property_is_evaluated_within_another(tmp_path: Path) -> None:
    """A property evaluated lazily within an expression does not disturb that expression."""
    properties = "".join(
        f'<xacro:property name="{name}" value="{value}"/>'
        for name, value in {"x": "2", "a": "${x*2}", "b": "${x*3}", "f": "${lambda q: q*2}"}.items()
    )

    text = expand(tmp_path, f'{properties}<link name="${{a*2 + b*3}}_${{f(4)*3 + x*a}}"/>')

    assert '<link name="26_32"/>' in text


def doubled(first: str, then: str) -> str:
    """A property a0 and forty more, each built from the previous one."""
    return first + "".join(then.format(i + 1, i) for i in range(40))


@pytest.mark.parametrize(
    "body",
    [
        doubled('<xacro:property name="a0" value="aaaa"/>', '<xacro:property name="a{0}" value="${{a{1}}}${{a{1}}}"/>')
        + '<link name="${a40}"/>',
        doubled('<xacro:property name="a0" value="aaaa"/>', '<xacro:property name="a{0}" value="${{a{1} + a{1}}}"/>')
        + '<link name="${a40}"/>',
        doubled('<xacro:property name="a0" value="${[1]}"/>', '<xacro:property name="a{0}" value="${{[a{1}]*2}}"/>')
        + '<link name="${a40}"/>',
    ],
)
def test_properties_that_double_are_stopped(tmp_path: Path, body: str) -> None:
    with pytest.raises(DescriptionError, match=r"more than 1000000|at most [\d.]+ (steps|MiB|s of)"):
        expand(tmp_path, body)


def test_yaml_lists_nested_by_aliases_are_stopped(tmp_path: Path) -> None:
    lists = [f"{chr(98 + i)}: &{chr(98 + i)} [{', '.join([f'*{chr(97 + i)}'] * 9)}]" for i in range(9)]
    (tmp_path / "bomb.yaml").write_text("\n".join(["a: &a [x, x, x]", *lists]))

    with pytest.raises(DescriptionError, match="aliases stand for more than 500000 values"):
        expand(tmp_path, "<link name=\"${xacro.load_yaml('bomb.yaml')}\"/>")


def test_repeated_insertion_of_a_long_text_is_stopped(tmp_path: Path) -> None:
    macros = '<xacro:macro name="m0"><link name="${a}"/></xacro:macro>' + "".join(
        f'<xacro:macro name="m{i + 1}"><xacro:m{i}/><xacro:m{i}/></xacro:macro>' for i in range(8)
    )
    long = '<xacro:property name="a" value="${\'a\' * 999999}"/>'

    with pytest.raises(DescriptionError, match=r"at most \d+ MiB of values"):
        expand(tmp_path, f"{long}{macros}<xacro:m8/>")


def test_blocks_that_double_are_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.robots.description.xacro.expand._MAX_ELEMENTS", 2000)
    block = '<xacro:property name="a{0}"><xacro:insert_block name="a{1}"/><xacro:insert_block name="a{1}"/>'
    bomb = doubled('<xacro:property name="a0"><!-- nothing --></xacro:property>', f"{block}</xacro:property>")

    with pytest.raises(DescriptionError, match="more than 2000 elements"):
        expand(tmp_path, f'{bomb}<xacro:insert_block name="a40"/>')


def test_macros_that_double_are_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.robots.description.xacro.expand._MAX_ELEMENTS", 2000)
    macros = '<xacro:macro name="m0"><link name="l"/></xacro:macro>' + "".join(
        f'<xacro:macro name="m{i + 1}"><xacro:m{i}/><xacro:m{i}/></xacro:macro>' for i in range(40)
    )

    with pytest.raises(DescriptionError, match="more than 2000 elements"):
        expand(tmp_path, f"{macros}<xacro:m40/>")


def test_a_file_that_is_far_too_large_is_not_read_into_memory(tmp_path: Path) -> None:
    file = tmp_path / "x.xacro"
    with file.open("wb") as hole:
        hole.truncate(100_000_000)

    with pytest.raises(DescriptionError, match=r"x\.xacro: error: larger than 67108864 bytes"):
        expand_xacro(file, {}, packages=Packages({}, start=tmp_path), report=Diagnostics())

"""Files that include or repeat one another twice: reading ends in a sentence, long before what they stand for."""

from collections.abc import Callable
from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics, Source
from trundle.base.xmlnode import ReadBudget, ReadBudgetError
from trundle.robots.description import expand_xacro, load
from trundle.robots.launch import read_launch
from trundle.robots.packages import Packages

_XACRO = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">{}</robot>'
_SDF = '<sdf version="1.7"><model name="m"><link name="l"/>{}</model></sdf>'
_DEPTH = 14
_AT = Source("a.sdf", 1)


def _expand(path: Path) -> object:
    return expand_xacro(path, {}, packages=Packages({}, start=path), report=Diagnostics())


def _launch(path: Path) -> object:
    return read_launch(path, packages=Packages({}, start=path), report=Diagnostics())


def _sdf(path: Path) -> object:
    return load(str(path), Diagnostics(), packages=Packages({}, start=path))


@pytest.fixture
def limit(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Sets limits nearer, so that the tests are quick."""

    def set_limits(**limits: int) -> None:
        for name, value in limits.items():
            monkeypatch.setitem(ReadBudget.__init__.__kwdefaults__ or {}, name, value)

    return set_limits


def _doubling(folder: Path, suffix: str, include: str, document: str) -> Path:
    """Write files each of which includes the next one twice."""
    for number in range(_DEPTH):
        inner = include.format(number + 1) * 2 if number + 1 < _DEPTH else ""
        (folder / f"{number}{suffix}").write_text(document.format(inner))
    return folder / f"0{suffix}"


_INCLUDES = [
    (_launch, ".launch", '<include file="$(dirname)/{}.launch"/>', "<launch>{}</launch>"),
    (_expand, ".xacro", '<xacro:include filename="{}.xacro"/>', _XACRO),
    (_sdf, ".sdf", "<include><uri>{}.sdf</uri></include>", _SDF),
]  # fmt: skip


@pytest.mark.parametrize(("read", "suffix", "include", "document"), _INCLUDES, ids=[each[1] for each in _INCLUDES])
@pytest.mark.parametrize(("message", "limits"), [("100 files", {"files": 100}), ("0 MiB of text", {"octets": 20_000})])
def test_includes_that_double_end_with_the_chain(
    tmp_path: Path,
    limit: Callable[..., None],
    read: Callable[[Path], object],
    suffix: str,
    include: str,
    document: str,
    message: str,
    limits: dict[str, int],
) -> None:
    limit(**limits)
    top = _doubling(tmp_path, suffix, include, document)

    with pytest.raises(
        ReadBudgetError, match=f"with its included files and repeated macros, takes more than {message}"
    ) as ended:
        read(top)
    assert f"0{suffix}" in str(ended.value)
    assert f"1{suffix}" in str(ended.value)


_TWICE = '<xacro:insert_block name="b"/>' * 2
_MACRO = '<xacro:macro name="m{}" params="*b">{}</xacro:macro>'
_BLOCKS = _MACRO.format(0, f"<g>{_TWICE}</g>") + "".join(
    _MACRO.format(i, f"<xacro:m{i - 1}><g>{_TWICE}</g></xacro:m{i - 1}>") for i in range(1, 25)
)
_REPEATS = {
    "blocks": f"{_BLOCKS}<xacro:m24><a/></xacro:m24>",
    "macros that call themselves twice": '<xacro:macro name="m" params="n"><xacro:if value="${n}"><xacro:m n="${n-1}"/>'
    '<xacro:m n="${n-1}"/></xacro:if></xacro:macro><xacro:m n="30"/>',
    "elements that are dropped": f'<xacro:macro name="m" params=""><xacro:if value="0">{"<a/>" * 500}</xacro:if>'
    f"</xacro:macro>{'<xacro:m/>' * 100}",
    "comments": f'<xacro:macro name="m" params=""><a>{"<!---->" * 500}</a></xacro:macro>{"<xacro:m/>" * 100}',
    "attributes": '<xacro:macro name="m" params=""><a {}/></xacro:macro>{}'.format(
        " ".join(f'a{i}="1"' for i in range(500)), "<xacro:m/>" * 100
    ),
}


@pytest.mark.parametrize("inside", _REPEATS.values(), ids=_REPEATS)
def test_xacro_that_repeats_much_ends_in_a_sentence(tmp_path: Path, limit: Callable[..., None], inside: str) -> None:
    limit(nodes=10_000)
    path = tmp_path / "a.xacro"
    path.write_text(_XACRO.format(inside))
    with pytest.raises(
        ReadBudgetError, match="takes more than 10000 elements and values; check for includes or macros that multiply"
    ):
        _expand(path)


_LAUNCHES = {
    "arguments": '<arg name="a" value="xxxxxxxxxx"/>'
    + "".join(f'<arg name="a{i}" value="{f"$(arg a{i - 1 if i else str()})" * 2}"/>' for i in range(40)),
    "values of YAML": "<rosparam>{a: [1, 2, 3, 4, 5, 6, 7, 8, 9]}</rosparam>" * 2000,
    "aliases": "<rosparam>{a: &amp;a [1, 1, 1, 1, 1, 1, 1], b: [*a, *a]}</rosparam>" * 2000,
    "typed values": '<param name="a" type="yaml" value="[1, 2, 3, 4, 5, 6, 7, 8, 9]"/>' * 2000,
    "groups": "<group>" * 100 + '<param name="a" value="1"/>' * 3000 + "</group>" * 100,
}  # fmt: skip


@pytest.mark.parametrize("inside", _LAUNCHES.values(), ids=_LAUNCHES)
def test_a_launch_that_repeats_much_ends_in_a_sentence(tmp_path: Path, limit: Callable[..., None], inside: str) -> None:
    limit(nodes=10_000, octets=100_000)
    path = tmp_path / "a.launch"
    path.write_text(f"<launch>{inside}</launch>")
    with pytest.raises(ReadBudgetError, match=r"takes more than (10000 elements and values|0 MiB of text)"):
        _launch(path)


def test_populations_count_as_their_models(tmp_path: Path, limit: Callable[..., None]) -> None:
    limit(nodes=10_000)
    population = (
        '<population name="p{}"><model name="m{}"><link name="l"/></model><model_count>300</model_count>'
        "<box><size>9 9 9</size></box></population>"
    )
    path = tmp_path / "a.world"
    path.write_text(
        f'<sdf version="1.7"><world name="w">{"".join(population.format(i, i) for i in range(3))}</world></sdf>'
    )
    with pytest.raises(ReadBudgetError, match="takes more than 10000 elements and values"):
        _sdf(path)


def test_reading_is_refused_after_its_time_limit() -> None:
    budget = ReadBudget(cpu_s=-1.0)
    with pytest.raises(ReadBudgetError, match="takes more than the time that files of their size take"):
        budget.add_file("a.sdf", 10, _AT)
    grown = ReadBudget(cpu_s=0.0)
    grown.add_file("a.sdf", 10_000_000, _AT)
    grown.add_file("a.sdf", 0, _AT)


def test_many_legitimate_repetitions_are_read(tmp_path: Path) -> None:
    """A world of a thousand includes, a robot of a thousand links."""
    (tmp_path / "tree.sdf").write_text('<sdf version="1.7"><model name="m"><link name="l"/></model></sdf>')
    includes = "".join(f"<include><uri>tree.sdf</uri><name>t{i}</name></include>" for i in range(1000))
    world = tmp_path / "a.world"
    world.write_text(f'<sdf version="1.7"><world name="w">{includes}</world></sdf>')
    assert len(load(str(world), Diagnostics(), packages=Packages({}, start=world)).world.models) == 1000

    macro = '<xacro:macro name="m" params="n"><link name="l${n}"/></xacro:macro>'
    robot = tmp_path / "a.xacro"
    robot.write_text(_XACRO.format(macro + "".join(f'<xacro:m n="{i}"/>' for i in range(1000))))
    assert str(_expand(robot)).count("<link") == 1000

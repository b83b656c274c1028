"""Launch files and YAML: `trundle check`, parameter files, maps."""

import json
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from trundle.gazebo.check.check_file import check
from trundle.gazebo.nodes.map_server.occupancy_grid import read_map

from .seeds import picture, seed
from .target import Execute, Target, reads_file, write_file

_WORDS = (
    b"$(arg a)", b"$(eval arg('a') + 1)", b"$(eval 9**9999)", b"$(anon x)", b"$(env HOME)", b"$(optenv A b c)",
    b"$(find p)/x", b"$(dirname)", b"pass_all_args", b"ns", b"unless", b"subst_value", b"textfile", b"binfile",
    b"command", b"!degrees 90", b"rad(pi)", b"deg(x)", b"!!binary aGk=", b"!!set {a}", b"2001-13-45", b"<<: *r",
    b"? a", b".inf", b"0o17", b"1_000", b"12:30:45", b"<include file='$(dirname)/l.launch'/>",
    b"<test test-name='t' pkg='p' type='t'/>",
)  # fmt: skip


@contextmanager
def _open_launch(folder: Path) -> Generator[Execute]:
    def execute(data: bytes) -> None:
        write_file(folder / "l.launch", data)
        result = check(str(folder / "l.launch"), {"HOME": str(folder)}, start=folder)
        json.dumps(result.as_json(), allow_nan=False)
        result.text()

    yield execute


@contextmanager
def _open_parameters(folder: Path) -> Generator[Execute]:
    """Read a parameter file through a launch file next to it."""
    (folder / "package.xml").write_text("<package><name>p</name></package>")
    (folder / "p.launch").write_text('<launch><rosparam file="$(dirname)/p.yaml" subst_value="true"/></launch>')

    def execute(data: bytes) -> None:
        write_file(folder / "p.yaml", data)
        json.dumps(check(str(folder / "p.launch"), {}, start=folder).as_json(), allow_nan=False)

    yield execute


@contextmanager
def _open_map(folder: Path) -> Generator[Execute]:
    (folder / "map.pgm").write_bytes(picture("PPM", "L"))
    with reads_file("map.yaml", read_map)(folder) as execute:
        yield execute


@contextmanager
def _open_picture(folder: Path) -> Generator[Execute]:
    """Read a map's picture."""
    (folder / "map.yaml").write_bytes(seed("map.yaml"))

    def execute(data: bytes) -> None:
        write_file(folder / "map.pgm", data)
        read_map(folder / "map.yaml")

    yield execute


TARGETS = {
    "launch": Target(
        open=_open_launch,
        seeds=lambda: [seed("robot.launch")],
        words=_WORDS,
        corpus=("invalid/launch/**/*", "repos/**/*.launch", "repos/**/*.test"),
    ),
    "yaml": Target(
        open=_open_parameters,
        seeds=lambda: [seed("parameters.yaml")],
        words=_WORDS,
        corpus=("repos/**/*.yaml",),
    ),
    "pgm": Target(
        open=_open_picture,
        seeds=lambda: [picture("PPM", "L"), b"P2 # map\n2 2 255\n0 254 205 7\n"],
        words=(b"P2", b"P5", b"P6", b"# c\n", b"65535", b"-1", b"99999999999", b"0"),
    ),
    "map": Target(open=_open_map, seeds=lambda: [seed("map.yaml")], words=_WORDS),
}

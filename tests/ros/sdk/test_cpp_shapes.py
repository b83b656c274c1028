"""Shapes and meshes of geometric_shapes in compiled programs."""

import re
import struct
import subprocess
import sys
from pathlib import Path

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

pytestmark = pytest.mark.slow

_CORNERS = [(0, 0, 0), (1, 0, 0), (0, 0, 1), (0, 1, 0), (1, 1, 0), (0, 1, 1)]
_FACES = [(0, 1, 2), (3, 5, 4), (0, 3, 4), (0, 4, 1), (0, 2, 5), (0, 5, 3), (1, 4, 5), (1, 5, 2)]
"""A wedge of half a cubic metre."""
_WEDGE = "6 8 (0 0 0) (1 1 1) 0.5"
_SOURCE = (
    '<source id="s"><float_array id="a" count="18">{numbers}</float_array><technique_common>'
    '<accessor source="#a" count="6" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>'
    '</technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>'
).format(numbers=" ".join(str(number) for corner in _CORNERS for number in corner))
_INPUT = '<input semantic="VERTEX" source="#v" offset="0"/>'
_TRIANGLES = f"<triangles>{_INPUT}<p>{' '.join(str(i) for face in _FACES for i in face)}</p></triangles>"


def _binary_stl(count: int = len(_FACES), header: bytes = b"") -> bytes:
    faces = (struct.pack("<3f9fH", 0, 0, 0, *(n for i in face for n in _CORNERS[i]), 0) for face in _FACES)
    return header.ljust(80, b"\0") + struct.pack("<I", count) + b"".join(faces)


def _ascii_stl() -> str:
    lines = [f"vertex {' '.join(f'{n:.3e}' for n in _CORNERS[i])}" for face in _FACES for i in face]
    return "solid vertex of a name\n" + "\n".join(lines) + "\nendsolid\n"


def _obj() -> str:
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in _CORNERS)
    return vertices + "vn 0 0 1\nf 1 2 3\nf 4/1 6/1 5/1\nf 1//1 4//1 \\\n5//1 2//1\nf -6 -4 -1 -3\nf 2 5 6 3\nl 1 2\n"


def _dae(
    mesh: str = _TRIANGLES, node: str = '<node><instance_geometry url="#g"/></node>', asset: str = "", more: str = ""
) -> str:
    return (
        f'<?xml version="1.0"?><COLLADA version="1.4.1">{asset}<library_geometries><geometry id="g"><mesh>'
        f"{_SOURCE}{mesh}</mesh></geometry></library_geometries>{more}<library_visual_scenes><visual_scene id='w'>"
        f'{node}</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>'
    )


_POLYGONS = f"<polylist>{_INPUT}<vcount>3 3 4 4 4</vcount><p>0 1 2 3 5 4 0 3 4 1 0 2 5 3 1 4 5 2</p></polylist>"
_STRIP = (
    f"<tristrips>{_INPUT}<p>1 0 4 3</p><p>0 2 3 5</p><p>2 1 5 4</p></tristrips>"
    f"<trifans>{_INPUT}<p>0 1 2</p></trifans><polygons>{_INPUT}<p>3 5 4</p></polygons>"
)
_LEAF = '<node id="leaf"><instance_geometry url="#g"/></node>'
_SKIN = '<library_controllers><controller id="c"><skin source="#g"/></controller></library_controllers>'


def _instances(number: int) -> str:
    return f"<instance_node url='#n{number}'/>" * 8


@pytest.mark.parametrize(
    ("name", "contents", "expected"),
    [
        ("wedge.stl", _binary_stl(), _WEDGE),
        ("solid.STL", _binary_stl(header=b"solid of SolidWorks"), _WEDGE),
        ("long.stl", _binary_stl() + b"more", _WEDGE),
        ("text.stl", _ascii_stl(), _WEDGE),
        ("wedge.obj", _obj(), _WEDGE),
        ("wedge.dae", _dae(), _WEDGE),
        ("inches.dae", _dae(asset='<asset><unit meter="0.0254"/><up_axis>Y_UP</up_axis></asset>'), _WEDGE),
        ("polygons.dae", _dae(_POLYGONS), _WEDGE),
        ("strips.dae", _dae(_STRIP), _WEDGE),
        ("skin.dae", _dae(node='<node><instance_controller url="#c"/></node>', more=_SKIN), _WEDGE),
        (
            "moved.dae",  # scaled, turned by 90° about z, moved; then the half of it again, mirrored
            _dae(
                node="<node><translate>1 0 0</translate><rotate>0 0 1 90</rotate><scale>2 2 2</scale>"
                '<instance_geometry url="#g"/></node>'
                "<node><matrix>-1 0 0 9  0 1 0 0  0 0 1 0  0 0 0 1</matrix><instance_node url='#leaf'/></node>",
                more=f"<library_nodes>{_LEAF}</library_nodes>",
            ),
            "12 16 (-1 0 0) (9 2 2) 4.5",
        ),
    ],
)  # fmt: skip
def test_a_mesh_is_read(running: Running, tmp_path: Path, name: str, contents: str | bytes, expected: str) -> None:
    assert _read(running, _written(tmp_path, name, contents)) == [expected]


def test_a_mesh_is_read_from_memory_and_scaled(running: Running, tmp_path: Path) -> None:
    """The name of a file tells its format, or else its first bytes do."""
    files = [_written(tmp_path, name, data) for name, data in (("a", _binary_stl()), ("b", _obj()), ("c", _dae()))]
    hints = [f"wedge.stl:{files[0]}", f"obj:{files[1]}", *(f":{file}" for file in files)]

    assert _read(running, *hints) == ["6 8 (0 0 0) (2 2 2) 4"] * 5


@pytest.mark.parametrize(
    ("name", "contents", "fault"),
    [
        ("short.stl", _binary_stl()[:-1], "it declares 8 triangles and contains 7"),
        ("large.stl", _binary_stl(count=2**32 - 1), "it declares 4294967295 triangles and contains 8"),
        ("header.stl", b"\0" * 83, "it declares 0 triangles and contains 0"),
        ("cut.stl", _ascii_stl().rpartition("vertex")[0], "it ends inside a triangle"),
        ("words.stl", "solid\nvertex 0 0 nan\n", "vertex 1 has no three numbers"),
        ("infinite.stl", _binary_stl()[:96] + struct.pack("<f", float("inf")) + _binary_stl()[100:], "is not finite"),
        ("none.stl", b"", "it is empty"),
        ("far.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "line 3: a face names vertex '3' of 2"),
        ("zero.obj", "v 0 0 0\nf 0 1 1\n", "line 2: a face names vertex '0' of 1"),
        ("words.obj", "v 0 zero 0\n", "line 1: a vertex has no three numbers"),
        ("none.obj", "v 0 0 0\n", "it has no triangles"),
        ("cut.dae", _dae()[:-3], "line 1: "),
        ("deep.dae", "<a>" * 100_000, "there are too many elements in elements"),
        ("far.dae", _dae(f"<triangles>{_INPUT}<p>0 1 6</p></triangles>"), "<p> names vertex 6 of 6"),
        ("below.dae", _dae(f"<triangles>{_INPUT}<p>0 1 -1</p></triangles>"), f"<p> names vertex {2**64 - 1} of 6"),
        ("short.dae", _dae(f"<polylist>{_INPUT}<vcount>3 9</vcount><p>0 1 2 3</p></polylist>"), "<p> has less corners"),
        ("wide.dae", _dae(_TRIANGLES.replace('offset="0"', 'offset="18446744073709551615"')), "is too large"),
        ("other.dae", _dae(node='<node><instance_geometry url="#h"/></node>'), "it names '#h', which it has not"),
        ("ring.dae", _dae(node='<node id="n"><instance_node url="#n"/></node>'), "its nodes are too many, or endless"),
        (
            "many.dae",  # 8 instances of 8 of … of 8 of a node
            _dae(
                node="<instance_node url='#n7'/>",
                more="<library_nodes>"
                + "".join(f"<node id='n{i}'>{_instances(i - 1)}</node>" for i in range(1, 8))
                + f"{_LEAF.replace('leaf', 'n0')}</library_nodes>",
            ),
            "its nodes are too many, or endless",
        ),
        ("wedge.ply", "ply\nformat ascii 1.0\n", "Trundle's development kit reads STL, OBJ and COLLADA"),
    ],
)  # fmt: skip
def test_a_faulty_mesh_is_refused_with_a_sentence(
    running: Running, tmp_path: Path, name: str, contents: str | bytes, fault: str
) -> None:
    file = _written(tmp_path, name, contents)
    output = _output(running, file)

    assert output.splitlines()[-1] == "none"
    assert f"Cannot read mesh '{file}': " in output
    assert fault in output


def test_a_mesh_that_is_not_there_is_refused(running: Running, tmp_path: Path) -> None:
    output = _output(running, f"file://{tmp_path}/none.stl", "package://no_such_package/none.stl")

    assert output.count("Error retrieving file") == 2
    assert "there is no package 'no_such_package'" in output


def test_shapes_their_messages_and_meshes(running: Running) -> None:
    assert re.search(r"^\d\d checks, 0 failed$", _output(running, program="shapes"), re.MULTILINE)


def test_a_mesh_of_a_package_is_put_into_the_scene(running: Running, graph: Graph, tmp_path: Path) -> None:
    node = graph.node("tester")
    words = ["launch", "arm_moveit_config", "demo.launch", "use_rviz:=false", "--headless"]
    environment = {**running.environment, "ROS_HOME": str(tmp_path)}
    with subprocess.Popen(
        [sys.executable, "-m", "trundle", *words],
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    ) as launch:  # fmt: skip
        try:
            until(lambda: graph.loop.run(node.params.search("/robot_description_semantic")))
            output = _output(running, program="placer")
        finally:
            launch.terminate()
        assert launch.stdout is not None
        log = launch.stdout.read()

    assert output.splitlines()[-2:] == ["applied 1", "wedge 1 6 8"], output + log


def _written(folder: Path, name: str, contents: str | bytes) -> str:
    file = folder / name
    file.write_bytes(contents.encode() if isinstance(contents, str) else contents)
    return str(file)


def _output(running: Running, *arguments: str, program: str = "meshes") -> str:
    if not (running.folder / "cpp_shapes" / program).exists():
        pytest.skip("this machine has no Eigen for C++")
    process = running.start(program, *arguments, package="cpp_shapes")
    output, _ = process.communicate(timeout=WAIT_S)
    assert process.returncode == 0, output
    return output


def _read(running: Running, *names: str) -> list[str]:
    return _output(running, *names).splitlines()

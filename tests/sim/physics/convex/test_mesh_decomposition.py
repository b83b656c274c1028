"""Hollow meshes that are cut into convex pieces: in other processes, each once, kept on disk, within a budget."""

import io
import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from trundle.gazebo.check.check_file import check
from trundle.sim.physics.convex import decomposition, jobs, mesh_decomposition, pieces
from trundle.sim.physics.convex.mesh_decomposition import WorldDecomposition, convex_pieces, load_pieces, save_pieces
from trundle.sim.physics.convex.native_output import native_output_hidden
from trundle.sim.physics.convex.pieces import ConcavePart, Detail, decompose_part
from trundle.sim.physics.convex.progress import DecompositionProgress
from trundle.sim.physics.convex.splitting import split_mesh

Mesh = tuple[NDArray[np.float64], NDArray[np.intp]]
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")


def gate(high: float = 1.5, at: float = 0.0) -> Mesh:
    """A closed block with a passage of 1 x 1 m, of a given height: two feet and a beam on them."""
    corners = [(x + at, y, z) for z in (0.0, 1.0, high) for y in (-0.5, 0.5) for x in (-1.0, -0.5, 0.5, 1.0)]
    cells = {(0, 0), (2, 0), (0, 1), (1, 1), (2, 1)}
    faces: list[tuple[int, int, int]] = []
    for i, j in sorted(cells):
        a, b, c, d = (i + 8 * j, i + 1 + 8 * j, i + 1 + 8 * (j + 1), i + 8 * (j + 1))
        sides = {(-1, 0): (d, d + 4, a + 4, a), (1, 0): (b, b + 4, c + 4, c), (0, -1): (a, a + 4, b + 4, b)}
        sides[0, 1] = (c, c + 4, d + 4, d)
        quads = [(a, b, c, d), (a + 4, d + 4, c + 4, b + 4)]
        quads += [quad for (di, dj), quad in sides.items() if (i + di, j + dj) not in cells]
        faces += [triangle for p, q, r, s in quads for triangle in ((p, q, r), (p, r, s))]
    return np.array(corners), np.array(faces, dtype=np.intp)


def open_box(*, double: bool) -> Mesh:
    """Four walls and a floor without thickness; once, or twice: facing outside and inside."""
    corners = np.array([(i & 1, i >> 1 & 1, (i >> 2) * 0.4) for i in range(8)], dtype=float)
    quads = [(0, 2, 3, 1), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    faces = np.array([t for p, q, r, s in quads for t in ((p, q, r), (p, r, s))], dtype=np.intp)
    return corners, np.concatenate([faces, faces[:, ::-1]]) if double else faces


def obj(mesh: Mesh) -> str:
    points, faces = mesh
    return "\n".join([*(f"v {x} {y} {z}" for x, y, z in points), *(f"f {a} {b} {c}" for a, b, c in faces + 1)])


def world(folder: Path, meshes: list[str], *, static: bool = False) -> Path:
    """A world file whose models each have one mesh."""
    models = ""
    for i, text in enumerate(meshes):
        (folder / f"m{i}.obj").write_text(text)
        models += (
            f'<model name="m{i}"><static>{static}</static><pose>0 {3 * i} 0 0 0 0</pose><link name="l"><collision '
            f'name="c"><geometry><mesh><uri>m{i}.obj</uri></mesh></geometry></collision></link></model>'
        )
    file = folder / "w.world"
    file.write_text(f'<sdf version="1.6"><world name="w">{models}</world></sdf>')
    return file


@pytest.fixture(autouse=True)
def cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Path]:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    mesh_decomposition.clear_cache()
    yield tmp_path / "cache/trundle/meshes"
    mesh_decomposition.clear_cache()


@pytest.fixture
def cut(monkeypatch: pytest.MonkeyPatch) -> list[ConcavePart]:
    """Meshes cut in this process, in order."""
    parts: list[ConcavePart] = []

    def counted(part: ConcavePart) -> pieces.ConvexPieces:
        parts.append(part)
        return decompose_part(part)

    monkeypatch.setattr(jobs, "decompose_part", counted)
    return parts


def corners_of(decomposed: pieces.ConvexPieces) -> list[list[list[float]]]:
    return [corners.tolist() for corners in decomposed.corners]


def test_a_worker_process_computes_the_same_pieces(monkeypatch: pytest.MonkeyPatch, cut: list[ConcavePart]) -> None:
    meshes = [(*gate(high), False) for high in (1.5, 1.6)]
    here = [corners_of(convex_pieces(points, faces, fixed=fixed)) for points, faces, fixed in meshes]
    assert len(cut) == 2
    monkeypatch.setenv("XDG_CACHE_HOME", "/nowhere")
    monkeypatch.setattr(jobs, "SHORT_S", 0.0)
    mesh_decomposition.clear_cache()
    world = WorldDecomposition()
    world.decompose_all(meshes)
    assert [corners_of(world.pieces_of(p, f, fixed=fixed).pieces) for p, f, fixed in meshes] == here
    assert len(cut) == 2


class _Deadly(np.ndarray):
    """Points that end the process that unpickles them."""

    def __reduce__(self) -> tuple[Callable[[int], None], tuple[int]]:
        return os._exit, (3,)


def test_a_mesh_that_crashes_its_worker_does_not_stop_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jobs, "SHORT_S", 0.0)
    monkeypatch.setattr(jobs, "_WORKER_S", 0.01)
    _, good = split_mesh(*gate(), fixed=False).concave[0]
    bad = ConcavePart(np.zeros((0, 3)).view(_Deadly), good.faces, Detail.HULL)
    results = {id(part): pieces_or_none for part, pieces_or_none in jobs.decompose_parts([bad, good, bad])}
    assert results[id(bad)] is None
    assert results[id(good)] is not None


def test_a_mesh_that_cannot_be_decomposed_becomes_its_hull_with_a_warning(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(jobs, "decompose_part", None)
    result = check(str(world(tmp_path, [obj(gate())])), {}, start=tmp_path, collisions=True)
    (message,) = [warning for warning in result.report.warnings if "hollow" in warning]
    assert "physics fills its cavities: 1.5 times its volume" in message
    assert message.endswith("; it could not be cut into convex pieces")
    assert not cache.exists()


def test_the_worker_imports_little_of_trundle() -> None:
    program = (
        "import sys, trundle.sim.physics.convex.pieces; print(*(name for name in sys.modules if 'trundle.' in name))"
    )
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert not re.findall(
        r"trundle\.(?:robots\.(?:meshes|model|description)|ros|sim\.(?:render|simulation)|live|page)\b", result.stdout
    )


def _children(pid: int) -> list[int]:
    try:
        return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except FileNotFoundError:
        return []


def _is_alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except FileNotFoundError:
        return False


def _wait_until(what: Callable[[], object]) -> None:
    for _ in range(3000):
        if what():
            return
        time.sleep(0.02)
    pytest.fail("it did not come to be within 60 s")


@LINUX
@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL], ids=["Ctrl-C", "the parent dies"])
def test_an_interruption_ends_all_processes_and_keeps_finished_pieces(
    end: signal.Signals, tmp_path: Path, cache: Path
) -> None:
    file = world(tmp_path, [obj(gate(1.5 + i / 100)) for i in range(40)])
    process = subprocess.Popen(
        [sys.executable, "-m", "trundle", "run", str(file), "--headless", "--no-ros", "--duration", "0.01", "--json"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    _wait_until(lambda: cache.is_dir() and len(list(cache.glob("*.npz"))) > 1)
    workers = _children(process.pid)
    process.send_signal(end)
    out, errors = process.communicate(timeout=60)
    assert process.returncode == (130 if end == signal.SIGINT else -end)
    assert out == ""
    assert "Traceback" not in errors
    assert workers
    _wait_until(lambda: not any(map(_is_alive, workers)))
    kept = list(cache.glob("pieces-*.npz"))
    assert 1 < len(kept) < 40
    assert all(load_pieces(path.stem.removeprefix("pieces-")) for path in kept)


def test_equal_meshes_are_decomposed_once_at_any_position(cut: list[ConcavePart]) -> None:
    points, faces = gate()
    both = np.concatenate([points, gate(at=5.0)[0]]), np.concatenate([faces, faces + len(points)])
    world = WorldDecomposition()
    world.decompose_all([(points, faces, False), (*both, False), (points / 2 * 2, faces, False)])
    assert len(cut) == 1
    first, second = (world.pieces_of(*mesh, fixed=False).pieces for mesh in (gate(), both))
    assert len(second.corners) == 2 * len(first.corners)
    assert np.concatenate(second.corners)[:, 0].max() == pytest.approx(6.0)


@pytest.mark.parametrize("double", [False, True])
def test_a_thin_shell_of_few_faces_becomes_a_slab_per_face(double: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decomposition, "_voxels", None)
    cut = convex_pieces(*open_box(double=double), fixed=False)
    assert len(cut.corners) == 5
    (error,) = cut.errors
    assert error.distance <= 0.0051  # half a wall of 1 cm
    assert not error.is_filled


@pytest.mark.parametrize("spoil", ["cut", "text", "other", "nan"])
def test_an_invalid_cached_decomposition_is_computed_again(spoil: str, cache: Path, cut: list[ConcavePart]) -> None:
    first = corners_of(convex_pieces(*gate(), fixed=False))
    (file,) = cache.glob("*.npz")
    if spoil == "other":
        save_pieces(file.stem.removeprefix("pieces-"), pieces.ConvexPieces([], []))
    elif spoil == "nan":
        save_pieces(file.stem.removeprefix("pieces-"), pieces.ConvexPieces([np.full((4, 3), np.nan)], []))
    else:
        file.write_bytes({"cut": file.read_bytes()[:200], "text": b"hello"}[spoil])
    mesh_decomposition.clear_cache()
    assert corners_of(convex_pieces(*gate(), fixed=False)) == first
    assert len(cut) == 2
    mesh_decomposition.clear_cache()
    convex_pieces(*gate(), fixed=False)
    assert len(cut) == 2


def test_slow_meshes_are_decomposed_coarsely_with_a_warning_regardless_of_the_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Two meshes of half a second each, and time for one.
    monkeypatch.setattr(mesh_decomposition, "MAX_SECONDS", 0.6)
    file = world(tmp_path, [obj(gate(1.5)), obj(gate(1.6))])

    def messages() -> list[str]:
        mesh_decomposition.clear_cache()
        result = check(str(file), {}, start=tmp_path, collisions=True)
        return [finding.what for finding in result.report.findings if "hollow mesh" in finding.what]

    in_full, coarse = messages()
    assert "fewer pieces" not in in_full
    assert re.search(r"uses [2-8] convex pieces: .*a surface up to \S+ m away; fewer pieces to save", coarse)
    assert coarse.endswith("to save time; TRUNDLE_FULL_DECOMPOSITION=1 computes all")
    monkeypatch.setenv("TRUNDLE_FULL_DECOMPOSITION", "1")
    assert not any("fewer pieces" in message for message in messages())  # and now both are cached in full
    monkeypatch.delenv("TRUNDLE_FULL_DECOMPOSITION")
    assert messages() == [in_full, coarse]


def test_a_part_that_another_thread_decomposes_is_waited_for(
    monkeypatch: pytest.MonkeyPatch, cut: list[ConcavePart], cache: Path
) -> None:
    """The simulation and the planner of one robot start together."""
    started, may_go_on = threading.Event(), threading.Event()
    decompose_parts = jobs.decompose_parts

    def decompose_late(parts: Sequence[ConcavePart], **options: bool) -> Generator[Any]:
        if parts:
            started.set()
            assert may_go_on.wait(10)
        yield from decompose_parts(parts, **options)

    monkeypatch.setattr(jobs, "decompose_parts", decompose_late)
    found: list[int] = []
    threads = [
        threading.Thread(target=lambda: found.append(len(convex_pieces(*gate(), fixed=False).corners))) for _ in "ab"
    ]
    threads[0].start()
    assert started.wait(10)
    threads[1].start()
    threads[1].join(0.2)
    assert not found
    may_go_on.set()
    for thread in threads:
        thread.join(10)

    assert len(found) == 2
    assert found[0] == found[1] > 1
    assert len(cut) == 1


def test_the_hull_replaces_a_concave_part_that_is_thin_beside_its_mesh() -> None:
    """The screws of a casing: a tenth of its size across, in a hundredth of its time."""
    big, bigger = gate(), gate(at=50.0)
    screws = [(points * 0.05 + (0.0, y, 0.0), faces) for y in (2.0, 3.0) for points, faces in [gate()]]
    points, faces = [], []
    for corners, triangles in (big, *screws):
        faces.append(triangles + sum(map(len, points)))
        points.append(corners)

    split = split_mesh(np.concatenate(points), np.concatenate(faces), fixed=False)
    alone = split_mesh(*bigger, fixed=False)

    assert [part.detail for _, part in split.concave] == [Detail.FULL, Detail.HULL, Detail.HULL]
    assert [part.detail for _, part in alone.concave] == [Detail.FULL]


def test_the_time_estimate_depends_on_the_size_only() -> None:
    points, faces = gate()
    part = ConcavePart(points, faces, Detail.FULL)
    coarse = ConcavePart(points, faces, Detail.COARSE)
    assert ConcavePart(points * 7, faces, Detail.FULL).seconds == part.seconds > coarse.seconds > 0


def test_check_decomposes_only_with_its_option(tmp_path: Path, cut: list[ConcavePart], cache: Path) -> None:
    file = world(tmp_path, [obj(gate())])
    result = check(str(file), {}, start=tmp_path)
    (message,) = [finding.what for finding in result.report.findings if "triangles" in finding.what]
    assert message == (
        "collision 'c': a mesh of 44 triangles that is not convex; its pieces are not checked (check --collisions)"
    )
    assert not cut
    check(str(file), {}, start=tmp_path, collisions=True)
    assert len(cut) == 1


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_terminal_shows_the_time_left_on_a_line_that_is_cleared(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    terminal = _Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    progress = DecompositionProgress([1.0] * 38, 2)
    now[0] += 9.0
    for _ in range(12):
        progress.done(1.0)
    drawn = [line.strip() for line in terminal.getvalue().split("\r")]
    assert drawn[1] == "cutting meshes: 0 of 38, about 19 s left"
    assert drawn[-1] == "cutting meshes: 12 of 38, about 20 s left"  # 12 in 9 s: 26 in 19.5 s
    progress.close()
    assert terminal.getvalue().split("\r")[-2:] == [" " * len(drawn[-1]), ""]


def test_a_log_has_a_first_and_a_last_line_for_long_decompositions(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    progress = DecompositionProgress([2.0] * 30, 2)
    now[0] += 27.0
    for _ in range(30):
        progress.done(2.0)
    progress.close()
    DecompositionProgress([0.5], 1).close()
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.splitlines() == [
        "cutting 30 hollow meshes into convex pieces, about 30 s; cached for later runs",
        "cut 30 of 30 hollow meshes in 27 s",
    ]


@pytest.mark.parametrize(
    ("faces", "is_convex"),
    [
        ([(0, 1, 2), (0, 2, 3)], True),
        ([(0, 1, 2)], True),
        ([(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)], True),
        ([(0, 1, 4), (0, 4, 3)], False),
    ],
)
def test_a_flat_mesh_is_convex_where_it_fills_the_polygon_around_it(
    faces: list[tuple[int, int, int]], is_convex: bool
) -> None:
    corners = np.array([*SQUARE, (0.4, 0.4, 0)], dtype=float)

    assert (split_mesh(corners, np.array(faces, dtype=np.intp), fixed=False).concave == []) is is_convex


SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
DEGENERATE = {
    "flat": SQUARE,
    "almost flat": [*SQUARE[:2], (1, 1, 1e-7), (0, 1, 0), (0.5, 0.5, 1e-7)],
    "flat and far away": [(x + 5000, y + 5000, z + 5000) for x, y, z in [*SQUARE[:3], (0, 1, 1e-4)]],
    "large and flat": [(x * 5000, y * 5000, 0) for x, y, _ in SQUARE],
    "a line": [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)],
    "a point": [(0, 0, 0)] * 4,
    "not a number": [*SQUARE, ("nan", 0, 0)],
    "infinite": [*SQUARE, ("inf", 0, 0)],
}


@pytest.mark.parametrize("static", [True, False])
@pytest.mark.parametrize("case", DEGENERATE)
def test_a_degenerate_mesh_is_reported_without_output_of_qhull(
    case: str, static: bool, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    corners = DEGENERATE[case]
    last = len(corners)
    faces = [(1, 2, 3), (1, 3, 4), (1, 2, last)]
    text = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {a} {b} {c}" for a, b, c in faces]
    file = world(tmp_path, ["\n".join(text)], static=static)
    result = check(str(file), {}, start=tmp_path, collisions=True)
    captured = capfd.readouterr()
    assert captured.out + captured.err == ""
    assert not result.report.errors
    messages = [warning for warning in result.report.warnings if "mesh" in warning or ".obj" in warning]
    assert messages or static  # static meshes have a slab behind each face, as thick as those of any mesh
    for warning in messages:
        assert "w.world:1: warning: " in warning
        assert re.search(r"physics uses [0-9.]+ mm|the collision is left out", warning)
    assert not re.search("qhull|engine", result.text(), re.IGNORECASE)


def test_output_of_others_is_printed_and_the_engines_hidden(capfd: pytest.CaptureFixture[str]) -> None:
    with native_output_hidden():
        os.write(2, b"QH7089 qhull precision warning: The initial hull is narrow.\n")
    with native_output_hidden():
        os.write(1, b"a line\n")
        os.write(2, b"a warning\n")
    assert capfd.readouterr() == ("a line\n", "a warning\n")

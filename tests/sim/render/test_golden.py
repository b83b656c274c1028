"""Pictures are reproduced to the byte on every x86-64 machine and instruction set.

Where a picture is to change, look at the new one and put it into `golden`.
"""

import os
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from tests.sim.render import golden_scenes

GOLDEN = Path(__file__).parent / "golden"
NEAR = 0 if platform.machine().lower() in ("x86_64", "amd64") else 2


@pytest.mark.parametrize("name", golden_scenes.SCENES)
def test_images_equal_the_golden_ones(name: str, tmp_path: Path) -> None:
    rendered = golden_scenes.draw(name)
    golden = np.asarray(Image.open(GOLDEN / f"{name}.png"))
    difference = np.abs(rendered.astype(int) - golden).max(axis=2)
    if difference.max() > NEAR:
        row, column = np.unravel_index(difference.argmax(), difference.shape)
        marked = np.where(difference[..., None] > NEAR, [255, 0, 255], rendered // 2).astype(np.uint8)
        Image.fromarray(np.hstack([golden, rendered, marked])).save(tmp_path / f"{name}.png")
        pytest.fail(
            f"{(difference > NEAR).sum()} pixels differ, most at row {row}, column {column}: "
            f"{golden[row, column]} became {rendered[row, column]}; was, is, and where: {tmp_path / name}.png"
        )


@pytest.mark.parametrize("threads", [2, 3, 64])
@pytest.mark.parametrize("name", golden_scenes.SCENES)
def test_any_number_of_threads_renders_the_same_bytes(name: str, threads: int) -> None:
    assert golden_scenes.draw(name, threads=threads).tobytes() == golden_scenes.draw(name).tobytes()


@pytest.mark.parametrize("threads", [1, 2, 3, 64])
@pytest.mark.parametrize("name", golden_scenes.SCENES)
def test_a_batch_renders_the_same_as_single_calls(name: str, threads: int) -> None:
    """However threads share their rows."""
    alone, together = golden_scenes.ready(name), golden_scenes.ready(name, threads=threads)
    pictures = together.render(golden_scenes.SEVERAL, depth=True, segmentation=True)
    singly = [alone.render([view], depth=True, segmentation=True)[0] for view in golden_scenes.SEVERAL]
    for picture, expected in zip(pictures, singly, strict=True):
        assert (picture.rgb == expected.rgb).all()
        assert picture.depth is not None
        assert expected.depth is not None
        assert np.array_equal(picture.depth, expected.depth)
        assert picture.segmentation is not None
        assert expected.segmentation is not None
        assert np.array_equal(picture.segmentation, expected.segmentation)
    assert len({picture.rgb.tobytes() for picture in pictures}) == len(pictures)


def test_every_instruction_set_renders_and_casts_the_same_bytes() -> None:
    def hashes(wish: str) -> str:
        program = [sys.executable, str(Path(golden_scenes.__file__))]
        environment = {**os.environ, "TRUNDLE_RENDER_ISA": wish}
        return subprocess.run(program, env=environment, capture_output=True, text=True, check=True).stdout

    outputs = {hashes(wish) for wish in ("baseline", "avx2", "avx512")}
    assert len(outputs) == 1
    assert "rays " in outputs.pop()

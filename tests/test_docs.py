"""Examples in the documentation run, and the files that it names exist."""

import re
import runpy
import shutil
from collections import Counter
from pathlib import Path

import pytest
from tests.docs_blocks import PAGES, ROOT, has_blocks, is_slow, read_blocks, run_page

if not PAGES:
    pytest.skip("the documentation is not part of the sdist", allow_module_level=True)
REASONS = Counter(
    {
        "a GPU": 1,  # tests/gym/test_gpu.py has it
        "a compiler": 2,  # tests/gazebo/plugins/compiled has one like it
        "a robot that drives": 1,  # tests/navigation/mapping drives one
        "a terminal": 1,
        "a workspace": 2,  # tests/ros/sdk compiles others
        "docker": 2,
        "minutes, to set everything up": 1,
        "stable-baselines3": 1,  # tests/gym has it
        "the cart, which is built by hand above": 1,  # tests/page/test_user_builds_a_cart.py builds it
        "the net": 11,
        "the robot above": 3,  # tests/navigation/move_base and tests/planning/move_group drive others
        "the tutorial's files": 1,  # tests/system/test_smartcar.py has them
    }
)
"""Reason → number of blocks that are not run."""
_PARTS = ["## Context", "## Decision", "## Alternatives"]
_FILE = re.compile(r"`((?:src|cpp|docs|tests|examples|bench|typings)/[\w./]+|[\w/]+\.(?:py|cc|h))(?::\w+)?`")


def _parameters() -> list[object]:
    marks = {True: [pytest.mark.slow], False: []}
    pages = filter(has_blocks, PAGES)
    return [pytest.param(page, id=str(page.relative_to(ROOT)), marks=marks[is_slow(page)]) for page in pages]


@pytest.mark.parametrize("page", _parameters())
def test_blocks_of_a_page_run(page: Path, tmp_path: Path) -> None:
    run_page(page, tmp_path)


_WITH_THE_RP2W = (
    "README.md",
    "docs/start.md",
    "docs/python.md",
    "docs/howto/drive.md",
    "docs/howto/python_page.md",
    "docs/howto/sweep.md",
    "src/trundle/assets/lessons/rp2w.md",
)


@pytest.mark.slow
@pytest.mark.parametrize("page", _WITH_THE_RP2W)
def test_a_page_runs_where_the_tutorials_model_is(page: str, shared: Path, tmp_path: Path) -> None:
    """`model://rp2w` is the tutorial's then, whose model is my_robot; worlds of Trundle keep Trundle's."""
    (tmp_path / ".gazebo/models").mkdir(parents=True)
    (tmp_path / ".gazebo/models/rp2w").symlink_to(shared / "seeds/rp2w")
    run_page(ROOT / page, tmp_path)


@pytest.mark.slow
def test_the_tutorials_run_with_their_own_files(shared: Path, tmp_path: Path) -> None:
    for folder in (".gazebo/models", "Downloads", "catkin_ws/src"):
        (tmp_path / folder).mkdir(parents=True)
    shutil.copytree(shared / "seeds/rp2w", tmp_path / ".gazebo/models/rp2w")
    shutil.copytree(shared / "seeds/smartcar_description", tmp_path / "catkin_ws/src/smartcar_description")
    shutil.copy(ROOT / "examples/rp2w/rp2w.py", tmp_path / "Downloads")

    run_page(ROOT / "docs/howto/original_tutorials.md", tmp_path)


def test_blocks_that_are_not_run_have_known_reasons() -> None:
    marks = [block.mark for page in PAGES for block in read_blocks(page)]
    assert Counter(mark.partition("needs ")[2] for mark in marks if mark.startswith("not run:")) == REASONS


@pytest.mark.parametrize("page", sorted((ROOT / "docs/decisions").glob("*.md")), ids=lambda page: page.stem[:4])
def test_a_decision_has_its_status_context_and_alternatives(page: Path) -> None:
    text = page.read_text()
    headings = [line for line in text.splitlines() if line.startswith("## ")]

    assert re.match(rf"# {page.name[:4]}: .+\n\nStatus: (accepted|replaced by \[)", text)
    assert [line for line in headings if line in _PARTS] == _PARTS


def _current(page: Path) -> bool:
    """Return False for decisions, which may name files that no longer exist."""
    return "decisions" not in page.parts


@pytest.mark.parametrize(
    "page", [page for page in PAGES if _current(page)], ids=lambda page: str(page.relative_to(ROOT))
)
def test_files_named_on_a_page_exist(page: Path) -> None:
    text = "".join(part for i, part in enumerate(page.read_text().split("```")) if i % 2 == 0)
    created = {Path(block.title).name for block in read_blocks(page) if block.title}
    named = {name for name in _FILE.findall(text) if name not in created}
    assert {name for name in named if not any((base / name).exists() for base in (ROOT, ROOT / "src/trundle"))} == set()


def test_the_table_of_sensor_topics_is_up_to_date() -> None:
    module = runpy.run_path(str(ROOT / "docs/generate/sensor_topics.py"))
    page = module["PAGE"].read_text()
    assert module["with_table"](page) == page, "make format rewrites it"


def test_every_package_is_in_the_architecture() -> None:
    plan = (ROOT / "ARCHITECTURE.md").read_text()
    wings = [path.parent for path in (ROOT / "src/trundle").glob("*/__init__.py")]
    rooms = [path.name for path in wings] + [path.parent.name for wing in wings for path in wing.glob("*/__init__.py")]
    assert [room for room in rooms if f"`{room}`" not in plan] == []

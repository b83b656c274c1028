"""A lesson's file loads, or the reason is said; it is read again when it has changed."""

import asyncio
from pathlib import Path

import pytest

from trundle.page.lessons.file_state import FileStates


def _fault(path: Path | str, states: FileStates | None = None) -> str | None:
    return asyncio.run((states or FileStates()).fault(str(path)))


@pytest.mark.parametrize(
    ("name", "good", "bad", "fault"),
    [
        ("drive.py", "x = 1\n", "x = \n", "it is no Python: invalid syntax"),
        ("a.yaml", "a: 1\n", "a: [\n", "line 2, column 1: "),
        ("model.config", "<model/>", "<model>", "model.config:1: error: "),
        ("any.txt", "x", None, None),
    ],
)
def test_a_file_is_parsed_by_its_suffix(tmp_path: Path, name: str, good: str, bad: str | None, fault: str) -> None:
    states, path = FileStates(), tmp_path / name

    async def follow() -> None:
        assert await states.fault(str(path)) == "it does not exist"
        path.write_text(good)
        assert await states.fault(str(path)) is None
        if bad is not None:
            path.write_text(bad)
            assert (await states.fault(str(path)) or "").startswith(fault)

    asyncio.run(follow())


@pytest.mark.parametrize("path", ["", "\0", "x" * 5000, "/dev/zero", "/"])
def test_what_is_no_file_does_not_load(path: str) -> None:
    assert _fault(path) is not None


@pytest.mark.slow
def test_a_description_is_checked_as_by_trundle_check(tmp_path: Path) -> None:
    path = tmp_path / "model.sdf"
    path.write_text('<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>')
    assert _fault(path) is None

    path.write_text('<sdf version="1.6"><model name="m"><link name="l"/></sdf>')
    assert ": error: " in (_fault(path) or "")

"""The notebooks of the examples run in Jupyter's kernel, and hold no outputs."""

import json
from pathlib import Path
from typing import Any

import pytest
from tests.docs_blocks import ROOT

NOTEBOOKS = sorted((ROOT / "examples/notebooks").glob("*.ipynb"))
_TIMEOUT_S = 600


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_small_and_without_outputs(path: Path) -> None:
    assert path.stat().st_size < 10_000
    cells = json.loads(path.read_text())["cells"]
    assert [cell for cell in cells if cell.get("outputs") or cell.get("execution_count")] == []


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
@pytest.mark.filterwarnings("default")  # those of Jupyter's own libraries
def test_a_notebook_runs(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    nbclient: Any = pytest.importorskip("nbclient", reason="Jupyter's client is not installed")
    pytest.importorskip("ipykernel", reason="Jupyter's kernel is not installed")
    nbformat: Any = pytest.importorskip("nbformat", reason="Jupyter's format is not installed")
    for variable in ("HOME", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR"):
        monkeypatch.setenv(variable, str(tmp_path))
    notebook = nbformat.read(path, as_version=4)

    nbclient.NotebookClient(notebook, timeout=_TIMEOUT_S, resources={"metadata": {"path": str(tmp_path)}}).execute()

    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert [output for output in outputs if output.get("name") == "stderr"] == []
    shown = {kind for output in outputs for kind in output.get("data", {})}
    assert "image/png" in shown
    expected = {"first_steps": "text/html", "experiment": "image/svg+xml"}
    assert expected.get(path.stem, "image/png") in shown

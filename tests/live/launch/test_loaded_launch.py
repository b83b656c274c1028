"""`trundle launch --nodes` and the like import nothing that runs nodes."""

import subprocess
import sys
from pathlib import Path


def test_listing_nodes_imports_no_heavy_modules(tmp_path: Path) -> None:
    file = tmp_path / "a.launch"
    file.write_text('<launch><node pkg="p" type="t" name="one"/><param name="x" value="1"/></launch>')
    code = (
        f"import sys; from trundle.app.cli import main; assert main(['launch', '--nodes', {str(file)!r}]) == 0;"
        "print([name for name in ('asyncio', 'numpy', 'mujoco', 'rosbags', 'aiohttp') if name in sys.modules])"
    )
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert process.stdout.splitlines() == ["/one", "[]"]


def test_a_headless_launch_does_not_import_the_page(tmp_path: Path) -> None:
    file = tmp_path / "a.launch"
    file.write_text(
        '<launch><node pkg="tf" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 a b 9"/></launch>'
    )
    words = ["launch", "--headless", "--duration", "0.1", str(file)]
    code = (
        f"import sys; from trundle.app.cli import main; assert main({words!r}) == 0;"
        "print([name for name in ('trundle.page.page_server', 'trundle.sim.render', 'mujoco') if name in sys.modules])"
    )
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert process.returncode == 0, process.stderr
    assert process.stdout.splitlines()[-1] == "[]"

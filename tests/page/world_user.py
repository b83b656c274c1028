"""User of a simulated world in the 3D view; the simulation's state is read over the page's protocol."""

import json
import math
import struct
from typing import Any

from tests.page.scene_user import PX_PER_M, Point, SceneUser
from tests.page_client import ProtocolClient

Point3 = tuple[float, float, float]
Pose = tuple[float, ...]
"""x y z [m], quaternion x y z w."""
_REST_NS, _REST_M = 300_000_000, 1e-3


class WorldUser(SceneUser):
    """Looks straight down at a simulated world, with a pixel per centimetre."""

    def __init__(self, browser: Any, url: str) -> None:
        """Open the page and wait for the world."""
        super().__init__(browser, url)
        self._client = ProtocolClient(url)
        for topic in ("trundle/world", "trundle/poses", "trundle/state"):
            self._client.subscribe(topic)
        self._poses: dict[int, Pose] = {}
        self._poses_ns = 0
        self.until(lambda: self.manifest() and self._poses, what="for the world")

    def look_down(self) -> None:
        self.side("Views")
        self.page.get_by_label("Type of view").select_option("TopDownOrtho")
        for name, value in (("Scale [px/m]", PX_PER_M), ("X [m]", 0), ("Y [m]", 0), ("Angle [rad]", 0)):
            self.set(name, str(value))
        self.side("Inspector")

    def drag(self, *points: Point) -> None:
        """Press at the first point, move over the others, release at the last."""
        self.page.mouse.move(*self.at(points[0]))
        self.page.mouse.down()
        for point in points[1:]:
            self.page.mouse.move(*self.at(point), steps=2)
        self.page.mouse.up()

    def manifest(self) -> dict[str, Any]:
        return self._last("trundle/world")

    @property
    def state(self) -> dict[str, Any]:
        """Return the clock's state."""
        return self._last("trundle/state")

    @property
    def is_paused(self) -> bool:
        return bool(self.state["paused"])

    def model(self, name: str) -> dict[str, Any] | None:
        return next((model for model in self.manifest().get("models", []) if model["name"] == name), None)

    def pose(self, model: str, link: int = 0) -> Pose | None:
        """Return the newest pose of a model's link; None if there is none."""
        self._read()
        entry = self.model(model)
        return None if entry is None else self._poses.get(entry["links"][link]["body"])

    def position(self, model: str, link: int = 0) -> Point3:
        pose = self.pose(model, link)
        assert pose is not None, model
        return pose[0], pose[1], pose[2]

    def until_at_rest(self, model: str) -> None:
        """Wait until a model has not moved for a while of simulated time, even if its poses arrive late."""

        def is_at_rest() -> bool:
            before, since_ns = self.position(model), self._poses_ns
            self.until(lambda: self.position(model) and self._poses_ns >= since_ns + _REST_NS)
            return math.dist(before, self.position(model)) < _REST_M

        self.until(is_at_rest, what=f"for {model} to rest")

    def pick(self, name: str) -> None:
        """Select an object in the tree."""
        self.page.get_by_role("treeitem").get_by_text(name, exact=True).first.click()

    def close(self) -> None:
        self._client.socket.close()
        super().close()

    def _last(self, topic: str) -> dict[str, Any]:
        self._read()
        payloads = self._client.payloads(topic)
        return json.loads(payloads[-1]) if payloads else {}

    def _read(self) -> None:
        while self._client.read(0.001):
            pass
        for payload in self._client.payloads("trundle/poses"):
            self._poses_ns, _, count = struct.unpack_from("<QII", payload)
            bodies = struct.unpack_from(f"<{count}I", payload, 16)
            numbers = struct.unpack_from(f"<{7 * count}f", payload, 16 + 4 * count)
            self._poses |= {body: numbers[7 * i : 7 * i + 7] for i, body in enumerate(bodies)}
        newest = {topic: index for index, (topic, _, _) in enumerate(self._client.messages)}
        self._client.messages = [self._client.messages[i] for t, i in sorted(newest.items()) if t != "trundle/poses"]

"""The three-dimensional half of the page: shapes, frames, camera frusta, the driven path, the ground's grid.

Every node hangs below `/view`, which moves against the followed body, and below `/view/root`, which carries the
inverse of the fixed frame: following and switching frames is one message, whatever the number of bodies.
"""

import numpy as np
import viser
from numpy.typing import NDArray

from trundle.spatial import compose_rows, invert_rows

from .batches import batches_of
from .content import ViewerScene, ViewerState
from .display import Display
from .framing import Extent, extent_of
from .lines import Lines
from .marks import Frames, Frusta, Path
from .mood import add_grid, add_lights, sky

_IDENTITY: NDArray[np.float64] = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])


class Stage:
    """Nodes of one scene on one server."""

    def __init__(self, server: viser.ViserServer, scene: ViewerScene) -> None:
        self._server = server
        self._scene = scene
        self._extent: Extent | None = None
        self._frame_index = {frame.name: i for i, frame in enumerate(scene.frames)}
        self._first: NDArray[np.float64] | None = None
        self._last: NDArray[np.float64] = np.zeros(3)
        self._shift: NDArray[np.float64] = np.zeros(3)
        self._recenter = False
        self._drawn_in = ""
        add = server.scene.add_frame
        self._view = add("/view", show_axes=False)
        self._root = add("/view/root", show_axes=False)
        self._visuals = add("/view/root/visuals", show_axes=False)
        self._collisions = add("/view/root/collisions", show_axes=False, visible=False)
        self._visual_batches = batches_of(server, "/view/root/visuals", scene.scene)
        self._collision_batches = (
            batches_of(server, "/view/root/collisions", scene.collisions, opacity=0.45) if scene.collisions else []
        )
        self._grid = add_grid(server, "/view/grid")
        add_lights(server, scene.scene)
        server.scene.set_background_image(sky(scene.scene), format="png")
        self._frames = Frames(server, "/view/root/frames", scene.frames)
        self._frusta = Frusta(server, "/view/root/cameras", scene.cameras)
        self._path = Path(server, "/view/root/path")
        self._lines = Lines(server, "/view/root/lines")

    @property
    def extent(self) -> Extent | None:
        """Where the robot was when first seen, in the fixed frame of then; None before the first state."""
        return self._extent

    def update(self, state: ViewerState, display: Display) -> tuple[str, ...]:
        """Draw a state as the toggles say; returns what to tell about it."""
        scene, told = self._scene, ()
        frame_poses = state.body_poses if state.frame_poses is None else state.frame_poses
        root = self._fixed_from_root(frame_poses, display.fixed_frame)
        if root is None:
            told = (f"Fixed Frame [{display.fixed_frame}] does not exist",)
            root = _IDENTITY
        if self._extent is None or self._extent.is_guess:
            fixed_from_bodies = compose_rows(np.tile(root, (len(state.body_poses), 1)), state.body_poses)
            self._measure(extent_of(scene, fixed_from_bodies))
        followed = None if scene.follow_body is None else state.body_poses[scene.follow_body]
        with self._server.atomic():
            self._root.position, self._root.wxyz = root[:3], root[3:]
            self._move_view(root, followed, display)
            self._show(display)
            if display.visuals:
                for batch in self._visual_batches:
                    batch.update(state.body_poses)
            if display.collisions:
                for batch in self._collision_batches:
                    batch.update(state.body_poses)
            self._frames.update(frame_poses, axes=display.frames, names=display.frames and display.names)
            self._frusta.update(state.body_poses, shown=display.cameras)
            self._lines.update(state.lines)
            self._path.update(state.time_ns, followed, shown=display.path)
        return told

    def _measure(self, extent: Extent) -> None:
        if self._extent is None or not extent.is_guess:
            self._frames.resize(extent.radius)
            self._frusta.resize(extent.radius)
            self._path.resize(extent.radius)
        self._extent = extent

    def image(self, index: int, rgb: NDArray[np.uint8]) -> None:
        """Show a camera's newest image in its frustum."""
        self._frusta.image(index, rgb)

    def recenter(self) -> None:
        """Bring the followed body to where it was first seen, which is where the camera looks."""
        self._recenter = True

    def _show(self, display: Display) -> None:
        for node, wanted in (
            (self._visuals, display.visuals),
            (self._collisions, display.collisions),
            (self._grid, display.grid),
        ):
            if node.visible != wanted:
                node.visible = wanted

    def _fixed_from_root(self, frame_poses: NDArray[np.float64], fixed_frame: str) -> NDArray[np.float64] | None:
        """Return the pose (7,) that puts the fixed frame at the origin; None where that frame has no pose."""
        if fixed_frame in ("", self._scene.root_frame) and fixed_frame not in self._frame_index:
            return _IDENTITY
        index = self._frame_index.get(fixed_frame)
        if index is None or not np.isfinite(frame_poses[index]).all():
            return None
        return invert_rows(frame_poses[index : index + 1])[0]

    def _move_view(
        self, fixed_from_root: NDArray[np.float64], followed: NDArray[np.float64] | None, display: Display
    ) -> None:
        """Hold the followed body still on the screen by moving everything else."""
        if followed is None or not np.isfinite(followed).all():
            return
        here = compose_rows(fixed_from_root[None], followed[None])[0, :3]
        if self._first is None or self._drawn_in != display.fixed_frame:
            self._first = self._last = here
            self._shift = np.zeros(3)
            self._drawn_in = display.fixed_frame
        if self._recenter:
            self._shift, self._recenter = self._first - here, False
        elif display.follow:
            self._shift = self._shift - (here - self._last)
        self._last = here
        if not np.array_equal(self._view.position, self._shift):
            self._view.position = self._shift

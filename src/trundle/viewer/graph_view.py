"""What a graph looks like at this moment: a robot's shapes hung on tf frames, all of them seen from one root.

Pure data in and out; who listens to topics and feeds the page is `graph_page`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trundle.render import Scene
from trundle.ros import TransformBuffer
from trundle.spatial import Pose

from .content import CameraView, FrameInfo, JointSlider, OptionGroup, ViewerScene, ViewerState
from .rviz import RvizConfig

_MAX_COMPLAINTS = 3
"""So many missing transforms are named; the rest are counted."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameTree:
    """The frames that tf knows, and which of them hang together with the fixed frame."""

    fixed_frame: str
    root: str
    """The topmost ancestor of the fixed frame; the fixed frame itself where tf does not know it."""
    parents: dict[str, str | None]
    """Every known frame, by name, with its parent."""

    @staticmethod
    def of(buffer: TransformBuffer, fixed_frame: str) -> "FrameTree":
        """Look at what a buffer holds now."""
        parents = dict(sorted(buffer.frames().items()))
        root, climbed = fixed_frame, {fixed_frame}
        while (parent := parents.get(root)) is not None and parent not in climbed:
            climbed.add(parent)
            root = parent
        return FrameTree(fixed_frame=fixed_frame, root=root, parents=parents)

    def poses(self, buffer: TransformBuffer) -> dict[str, Pose]:
        """Return `root_from_frame` of every frame that hangs together with the root, each by its newest transforms."""
        known: dict[str, Pose] = {self.root: Pose()} if self.root in self.parents else {}
        for frame in self.parents:
            chain: list[str] = []
            above: str | None = frame
            while above is not None and above not in known and above not in chain:
                chain.append(above)
                above = self.parents[above]
            if above is None or above not in known:
                continue
            for name in reversed(chain):
                transform = buffer.latest(name)
                assert transform is not None
                known[name] = known[transform.parent] @ transform.pose
        return known


def graph_scene(
    tree: FrameTree,
    robot: Scene,
    config: RvizConfig,
    *,
    title: str,
    collisions: Scene | None = None,
    sliders: Sequence[JointSlider] = (),
    images: Sequence[str] = (),
    figures: tuple[str, ...] = (),
    options: tuple[OptionGroup, ...] = (),
    joystick: bool = False,
) -> ViewerScene:
    """Lay out the page: what rviz's displays show, with joints and images beside it."""
    tf, odometry = config.enabled("TF"), config.enabled("Odometry")
    return ViewerScene(
        title=title,
        scene=Scene(
            bodies=robot.bodies,
            shapes=robot.shapes if config.enabled("RobotModel") else (),
            background=config.background,
        ),
        collisions=collisions,
        frames=tuple(FrameInfo(name, parent) for name, parent in tree.parents.items()),
        cameras=tuple(CameraView(topic, None) for topic in images),
        joints=tuple(sliders),
        figures=figures,
        drive=True,
        options=options,
        joystick=joystick,
        root_frame=tree.root,
        fixed_frame=tree.fixed_frame,
        follow_body=0 if robot.bodies else None,
        show_frames=bool(tf),
        show_path=bool(odometry),
    )


def graph_state(
    tree: FrameTree, buffer: TransformBuffer, robot: Scene, *, time_ns: int, expects_frames: bool = True
) -> ViewerState:
    """Return where everything is now, with rviz's own words about what is not known.

    Args:
        tree: of frames.
        buffer: knows where they are.
        robot: whose links are shown.
        time_ns: now.
        expects_frames: whether it is worth a word that there are none at all, of frames and of links.
    """
    known = tree.poses(buffer)
    status: list[str] = []
    if not expects_frames and not tree.parents and not robot.bodies:
        pass
    elif tree.fixed_frame not in tree.parents:
        status.append(f"Fixed Frame [{tree.fixed_frame}] does not exist")
    else:
        lost = [link for link in robot.bodies if link not in known]
        status += [f"No transform from [{link}] to [{tree.fixed_frame}]" for link in lost[:_MAX_COMPLAINTS]]
        if len(lost) > _MAX_COMPLAINTS:
            status.append(f"… and {len(lost) - _MAX_COMPLAINTS} more links without a transform")
    return ViewerState(
        time_ns=time_ns,
        body_poses=_rows(known, robot.bodies),
        frame_poses=_rows(known, tuple(tree.parents)),
        status=tuple(status),
    )


def _rows(known: dict[str, Pose], names: Sequence[str]) -> NDArray[np.float64]:
    """Stack the poses of frames, (names, 7); NaN where a frame has none."""
    rows = np.full((len(names), 7), np.nan)
    for row, name in zip(rows, names, strict=True):
        pose = known.get(name)
        if pose is not None:
            row[:] = (*pose.position, *pose.quaternion)
    return rows

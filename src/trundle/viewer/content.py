"""What the page shows: a scene with its frames, cameras and controls, and the state that moves it.

Plain data, small enough to pickle: the page lives in a process of its own.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trundle.render import Scene
from trundle.spatial import Pose


@dataclass(frozen=True, slots=True)
class FrameInfo:
    """One coordinate frame of a tf tree."""

    name: str
    parent: str | None = None


@dataclass(frozen=True, slots=True)
class CameraView:
    """A camera drawn as a frustum, with its live image in the panel and in the frustum."""

    name: str
    body: int | None
    """Index into the body poses; None where only the image is known, not the place it was taken from."""
    body_from_camera: Pose = Pose()
    """The camera looks along +x, y to the left, z up."""
    horizontal_fov_rad: float = 1.047
    width_px: int = 320
    height_px: int = 240


@dataclass(frozen=True, slots=True)
class JointSlider:
    """A movable joint: its range becomes a slider."""

    name: str
    lower: float
    """[m] or [rad]"""
    upper: float
    """[m] or [rad]"""
    position: float = 0.0


@dataclass(frozen=True, slots=True)
class PanelOption:
    """Something to tick, to write or to count: an option of a node."""

    name: str
    value: bool | int | float | str
    lower: float
    upper: float
    hint: str = ""


@dataclass(frozen=True, slots=True)
class OptionGroup:
    """The options of one node."""

    name: str
    options: tuple[PanelOption, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewerScene:
    """Everything of the page that stays the same while things move."""

    title: str
    scene: Scene
    """The visuals."""
    collisions: Scene | None = None
    """Collision shapes on the same bodies, drawn when asked for."""
    frames: tuple[FrameInfo, ...] = ()
    cameras: tuple[CameraView, ...] = ()
    joints: tuple[JointSlider, ...] = ()
    playback: bool = False
    """Offer play, pause, step, reset and speed."""
    drive: bool = False
    """Offer a pad and keys that steer a robot."""
    options: tuple[OptionGroup, ...] = ()
    """Nodes whose options may be changed."""
    figures: tuple[str, ...] = ()
    """Titles of drawings beside the scene: the graph's nodes, curves of topics."""
    joystick: bool = False
    """Offer a joystick to move, and read a real one."""
    root_frame: str = "world"
    """The frame in which every pose of the state is given."""
    fixed_frame: str | None = None
    """The frame the page draws in at first; None is `root_frame`."""
    follow_body: int | None = None
    """The body that "follow" keeps in view and whose path is drawn."""
    show_frames: bool = False
    """Draw the frames from the start."""
    show_path: bool = False
    """Draw the path of `follow_body` from the start."""


@dataclass(frozen=True, slots=True, eq=False)
class DrawnLine:
    """A line strip."""

    points: NDArray[np.float32]
    """(points, 3) in `root_frame` [m]."""
    rgb: tuple[int, int, int]
    """0 to 255."""


MAX_LINE_POINTS = 20_000
"""Of all lines of a state."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ViewerState:
    """One moment of a scene."""

    time_ns: int
    body_poses: NDArray[np.float64]
    """(bodies, 7): x y z [m], qw qx qy qz, in `root_frame`; a row with NaN is not drawn."""
    frame_poses: NDArray[np.float64] | None = None
    """(frames, 7), likewise; None where the frames are the bodies, in their order."""
    joint_positions: NDArray[np.float64] | None = None
    """(joints,) in the order of the sliders; None leaves the sliders to the person at the page."""
    real_time_factor: float | None = None
    paused: bool = False
    lines: tuple[DrawnLine, ...] = ()
    """At most `MAX_LINE_POINTS` in all."""
    status: tuple[str, ...] = ()
    """Lines for the panel, warnings among them."""

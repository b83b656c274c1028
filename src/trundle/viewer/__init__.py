"""The browser page: a scene that moves, camera images, and controls that a person presses.

viewer = Viewer.start(ViewerScene(title="rp2w", scene=scene, playback=True))
while True:
    viewer.show(ViewerState(time_ns=…, body_poses=…))
    for request in viewer.requests(): …
"""

from .content import MAX_LINE_POINTS, CameraView, DrawnLine, FrameInfo, JointSlider, ViewerScene, ViewerState
from .errors import ViewerError
from .graph_page import GraphPage
from .requests import Drive, MoveJoystick, Pause, Play, Request, Reset, SetFixedFrame, SetJoint, SetSpeed, Step
from .robot_scene import robot_scene
from .rviz import DEFAULT_CONFIG, RvizConfig, RvizDisplay, choose_fixed_frame, read_rviz_config
from .viewer import Viewer

__all__ = [
    "DEFAULT_CONFIG",
    "MAX_LINE_POINTS",
    "CameraView",
    "DrawnLine",
    "Drive",
    "FrameInfo",
    "GraphPage",
    "JointSlider",
    "MoveJoystick",
    "Pause",
    "Play",
    "Request",
    "Reset",
    "RvizConfig",
    "RvizDisplay",
    "SetFixedFrame",
    "SetJoint",
    "SetSpeed",
    "Step",
    "Viewer",
    "ViewerError",
    "ViewerScene",
    "ViewerState",
    "choose_fixed_frame",
    "read_rviz_config",
    "robot_scene",
]

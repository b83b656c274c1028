"""The panel beside the scene: time, playback, driving, joints, camera images, and what is drawn."""

import base64
import html
import math
import time
from collections.abc import Callable

import numpy as np
import viser
from numpy.typing import NDArray

from .content import JointSlider, ViewerScene, ViewerState
from .display import Display
from .drive import DrivePad
from .joystick import JoystickServer
from .options import add_options
from .requests import Pause, Play, Request, Reset, SetFixedFrame, SetJoint, SetSpeed, Step

_SPEEDS = {"¼ ×": 0.25, "½ ×": 0.5, "1 ×": 1.0, "2 ×": 2.0, "5 ×": 5.0, "max": math.inf}
_STATUS_PERIOD_S = 0.1
_JOINTS_PERIOD_S = 0.2
_OPEN_JOINTS = 12
"""More sliders than this start folded away."""
_SHORTEST_RANGE = 0.002
"""A joint whose limits coincide still needs a slider with two ends [m or rad]."""
_CAMERAS_WIDTH_PX = 300
_FIGURES_WIDTH_PX = 640
_HAND_OFF_S = 1.0
"""A slider that a person moved is left alone this long before it shows the joint's own position again."""


class Panel:
    """Controls of one scene; what is pressed goes to `send`, what is toggled to `display`."""

    def __init__(
        self,
        server: viser.ViserServer,
        scene: ViewerScene,
        display: Display,
        *,
        send: Callable[[Request], None],
        redraw: Callable[[], None],
        aim: Callable[[viser.ClientHandle, bool], None],
        joystick: Callable[[], JoystickServer],
    ) -> None:
        self._server = server
        self._scene = scene
        self._display = display
        self._send = send
        self._redraw = redraw
        self._aim = aim
        self._status_due = self._joints_due = 0.0
        server.gui.set_panel_label(scene.title)
        self._status = server.gui.add_html(_status_html(None, ()))
        if scene.playback:
            self._add_playback()
        if scene.drive:
            DrivePad(server, send)
        if scene.joystick:
            with server.gui.add_folder("Joystick"):
                server.gui.add_html(_joystick_html(joystick()))
        add_options(server, scene.options, send)
        self._left: viser.PanelHandle | None = None
        """The lowest at the left edge."""
        self._images = self._add_cameras()
        self._figures = self._add_figures()
        self._sliders = self._add_joints()
        self._add_views()
        self._add_display()

    def update(self, state: ViewerState, told: tuple[str, ...]) -> None:
        """Show time and state, a few times a second."""
        now = time.monotonic()
        if now >= self._status_due:
            self._status_due = now + _STATUS_PERIOD_S
            self._status.content = _status_html(state, told)
        if state.joint_positions is not None and now >= self._joints_due:
            self._joints_due = now + _JOINTS_PERIOD_S
            for slider, position in zip(self._sliders, state.joint_positions, strict=True):
                slider.show(float(position), now)

    def image(self, index: int, rgb: NDArray[np.uint8]) -> None:
        """Show a camera's newest image."""
        self._images[index].image = rgb
        self._images[index].visible = True

    def figure(self, index: int, svg: bytes) -> None:
        """Show a figure's newest drawing."""
        self._figures[index].content = _figure_html(svg)

    def _add_playback(self) -> None:
        gui = self._server.gui
        asked: dict[str, Request] = {"Play": Play(), "Pause": Pause(), "Step": Step(), "Reset": Reset()}
        buttons = gui.add_button_group("Time", tuple(asked))
        buttons.on_click(lambda _: self._send(asked[buttons.value]))
        speed = gui.add_dropdown("Speed", tuple(_SPEEDS), initial_value="1 ×", hint="Multiple of real time")
        speed.on_update(lambda _: self._send(SetSpeed(_SPEEDS[speed.value])))
        gui.add_command("Play", hotkey="P").on_trigger(lambda _: self._send(Play()))
        gui.add_command("Pause", hotkey="H").on_trigger(lambda _: self._send(Pause()))
        gui.add_command("Step", hotkey="N").on_trigger(lambda _: self._send(Step()))

    def _add_cameras(self) -> list[viser.GuiImageHandle]:
        cameras = self._scene.cameras
        if not cameras:
            return []
        self._left = panel = self._server.gui.add_panel()
        panel.dock_left()
        panel.set_width(_CAMERAS_WIDTH_PX)
        with panel.add_tab("Cameras"):
            blank = np.full((3, 4, 3), 60, dtype=np.uint8)
            return [self._server.gui.add_image(blank, label=camera.name, format="jpeg") for camera in cameras]

    def _add_figures(self) -> list[viser.GuiHtmlHandle]:
        """Each in a panel of its own, one below the other and all below the cameras: columns would share the width."""
        handles: list[viser.GuiHtmlHandle] = []
        for title in self._scene.figures:
            panel = self._server.gui.add_panel()
            if self._left is None:
                panel.dock_left()
            else:
                panel.dock_below(self._left)
            panel.set_width(_FIGURES_WIDTH_PX)
            with panel.add_tab(title):
                handles.append(self._server.gui.add_html(_figure_html(None)))
            self._left = panel
        return handles

    def _add_joints(self) -> list["_Slider"]:
        if not self._scene.joints:
            return []
        with self._server.gui.add_folder("Joints", expand_by_default=len(self._scene.joints) <= _OPEN_JOINTS):
            return [_Slider(self._server, joint, self._send) for joint in self._scene.joints]

    def _add_views(self) -> None:
        gui = self._server.gui
        views = gui.add_button_group("View", ("Reset", "Top"))

        @views.on_click
        def _(event: viser.GuiEvent[viser.GuiButtonGroupHandle]) -> None:
            if event.client is not None:
                self._aim(event.client, views.value == "Top")

        if self._scene.follow_body is not None:
            self._add_toggle("Follow robot", "follow")

    def _add_display(self) -> None:
        scene = self._scene
        with self._server.gui.add_folder("Display"):
            if scene.frames:
                self._add_fixed_frame()
                self._add_toggle("Frames", "frames")
                self._add_toggle("Frame names", "names")
            self._add_toggle("Visuals", "visuals")
            if scene.collisions is not None:
                self._add_toggle("Collisions", "collisions")
            if any(camera.body is not None for camera in scene.cameras):
                self._add_toggle("Camera frusta", "cameras")
            if scene.follow_body is not None:
                self._add_toggle("Path", "path")
            self._add_toggle("Grid", "grid")

    def _add_fixed_frame(self) -> None:
        names = [frame.name for frame in self._scene.frames]
        options = names if self._scene.root_frame in names else [self._scene.root_frame, *names]
        if self._display.fixed_frame not in options:
            options = [self._display.fixed_frame, *options]
        menu = self._server.gui.add_dropdown("Fixed frame", options, initial_value=self._display.fixed_frame)

        @menu.on_update
        def _(_: object) -> None:
            self._display.fixed_frame = menu.value
            self._send(SetFixedFrame(menu.value))
            self._redraw()

    def _add_toggle(self, label: str, name: str) -> None:
        box = self._server.gui.add_checkbox(label, bool(getattr(self._display, name)))

        @box.on_update
        def _(_: object) -> None:
            setattr(self._display, name, box.value)
            self._redraw()


class _Slider:
    """One joint's slider."""

    def __init__(self, server: viser.ViserServer, joint: JointSlider, send: Callable[[Request], None]) -> None:
        span = max(joint.upper - joint.lower, _SHORTEST_RANGE)
        # Rounded for the eye: the slider prints its ends. What is sent stays within the joint's own range.
        self._low, self._high = round(joint.lower, 3), round(joint.lower + span, 3)
        self._touched = -math.inf
        start = min(max(joint.position, self._low), self._high)
        self._handle = server.gui.add_slider(joint.name, self._low, self._high, span / 1000, start)

        @self._handle.on_update
        def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            if event.client_id is not None:  # None: the position shown changed, nobody touched the slider
                self._touched = time.monotonic()
                send(SetJoint(joint.name, min(max(float(event.target.value), joint.lower), joint.upper)))

    def show(self, position: float, now: float) -> None:
        """Follow the joint, unless a person has just moved the slider."""
        if math.isfinite(position) and now - self._touched > _HAND_OFF_S:
            clamped = min(max(position, self._low), self._high)
            if abs(clamped - self._handle.value) > (self._high - self._low) / 1000:
                self._handle.value = clamped


def _figure_html(svg: bytes | None) -> str:
    """A drawing as a picture of the page: what is written in it cannot do anything."""
    if svg is None:
        return "<p>waiting</p>"
    return (
        f'<img src="data:image/svg+xml;base64,{base64.b64encode(svg).decode()}" alt="" '
        'style="max-width:100%;display:block;margin:auto">'
    )


def _joystick_html(joystick: JoystickServer) -> str:
    frame = (
        f'<iframe src="{joystick.url}" allow="gamepad" title="joystick" '
        'style="width:100%;height:150px;border:0"></iframe>'
    )
    if joystick.url_elsewhere is None:
        return frame
    link = f'<a href="{joystick.url_elsewhere}" target="_blank">in a page of its own</a>'
    return f'{frame}<p style="font-size:0.8em;margin:0.3em">On other machines it works {link}.</p>'


def _status_html(state: ViewerState | None, told: tuple[str, ...]) -> str:
    style = "font-size:0.85em;padding:0.2em 0.6em 0.4em 0.6em;line-height:1.5"
    if state is None:
        return f'<div style="{style}">waiting for the first state</div>'
    factor = "" if state.real_time_factor is None else f" &nbsp; real-time factor <b>{state.real_time_factor:.2f}</b>"
    paused = " &nbsp; <b>paused</b>" if state.paused else ""
    lines = "".join(f'<div style="color:#c05000">{html.escape(line)}</div>' for line in (*told, *state.status))
    return f'<div style="{style}">time <b>{state.time_ns / 1e9:.2f} s</b>{factor}{paused}{lines}</div>'

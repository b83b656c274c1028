"""Session of a page, served as `/session.json`: title, panels and topics that its owner requests."""

from typing import Literal

import msgspec


class RvizFile(msgspec.Struct, frozen=True, kw_only=True):
    """The .rviz file that the page was started with, or that was saved last."""

    name: str
    text: str
    writable: bool
    """True if the file may be replaced."""
    saved: bool = False
    """True if the page saved it: `name` is its path from the working folder, and `SaveRvizAs` replaces it."""


class JointSlider(msgspec.Struct, frozen=True, kw_only=True):
    """Joint of joint_state_publisher_gui."""

    name: str
    lower: float
    """[rad or m]"""
    upper: float
    """[rad or m]"""
    position: float
    """[rad or m]"""


class NodeTerminal(msgspec.Struct, frozen=True, kw_only=True):
    """Terminal of a node; its channel is `trundle/terminal/N` with its index in the list."""

    name: str
    """Node's name."""
    ended: str | None = None
    """Message about the node's end; None: it runs."""


class Session(msgspec.Struct, frozen=True, kw_only=True):
    """Title, panels and topics of the page."""

    title: str
    kind: Literal["simulation", "graph", "log", "bag"]
    robot: str | None = None
    """Robot's name, for the tab's title."""
    rviz: RvizFile | None = None
    fixed_frame: str | None = None
    namespace: str = "/"
    """Namespace of the rviz node, for relative names in its file, its tf and its parameters."""
    remappings: dict[str, str] = {}
    """Remappings of the rviz node: global name → global name."""
    panels: tuple[str, ...] = ()
    """rqt's programs whose panels are open at the start: `rqt_graph`."""
    plots: tuple[str, ...] = ()
    """Curves of the plots panel: `/odom/pose/pose/position/x`."""
    images: tuple[str, ...] = ()
    """Image topics to show."""
    drive_topic: str | None = None
    """Topic of velocity commands; None: no driving."""
    sliders: tuple[JointSlider, ...] = ()
    joystick: bool = False
    """True if a joystick is shown: the launch has started a joy node."""
    terminals: tuple[NodeTerminal, ...] = ()
    lesson: str | None = None
    """Lesson that is open at the start: the name of one that Trundle brings, or a path FILE.md."""


class PageSession(Session, frozen=True, kw_only=True):
    """Session for a client, which reloads the page when `kind` or `version` changes."""

    version: str
    """Version of the server."""
    foxglove: str
    """Address for Foxglove and Lichtblick."""
    node: str | None
    """Name of the page's node on the graph; None: no graph, or not joined yet."""
    view_only: bool
    """True if this client must not change anything."""
    token: str | None
    """Token of links with full access; None: this client is view-only."""
    view_token: str
    """Token of view-only links."""
    network_urls: tuple[str, ...]
    """URLs of the page for other machines, without a path; empty: the page listens on loopback only."""

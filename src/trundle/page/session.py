"""Purpose of a page, as `/session.json` says it: title, panels and topics that its owner asks for."""

from typing import Literal

import msgspec


class RvizFile(msgspec.Struct, frozen=True, kw_only=True):
    """The .rviz file that the page was started with, or that was saved there last."""

    name: str
    text: str
    writable: bool
    """True if it may be replaced."""
    saved: bool = False
    """True if it was saved at the page: `name` is its path from the working folder, and `SaveRvizAs` replaces it."""


class JointSlider(msgspec.Struct, frozen=True, kw_only=True):
    """A joint of joint_state_publisher_gui."""

    name: str
    lower: float
    """[rad or m]"""
    upper: float
    """[rad or m]"""
    position: float
    """[rad or m]"""


class NodeTerminal(msgspec.Struct, frozen=True, kw_only=True):
    """A node's terminal, whose channel is `trundle/terminal/N` with its place in the list."""

    name: str
    """Name of the node."""
    ended: str | None = None
    """Sentence on the end of the node; None: it runs."""


class Session(msgspec.Struct, frozen=True, kw_only=True):
    """Purpose of the page; empty lists ask for nothing."""

    title: str
    kind: Literal["simulation", "graph", "log", "bag"]
    robot: str | None = None
    """Name of the robot that the page is about, for the tab's title."""
    rviz: RvizFile | None = None
    fixed_frame: str | None = None
    namespace: str = "/"
    """Namespace of the rviz node: of relative names in its file, of its tf and its parameters."""
    remappings: dict[str, str] = {}
    """Remappings of the rviz node: global name → global name."""
    panels: tuple[str, ...] = ()
    """rqt's programs whose panels are open from the start: `rqt_graph`."""
    plots: tuple[str, ...] = ()
    """Curves of the plots panel: `/odom/pose/pose/position/x`."""
    images: tuple[str, ...] = ()
    """Topics of pictures to show."""
    drive_topic: str | None = None
    """Topic of velocity commands; None: driving is not offered."""
    sliders: tuple[JointSlider, ...] = ()
    joystick: bool = False
    """True if a joystick is to be shown: the launch starts a joy node."""
    terminals: tuple[NodeTerminal, ...] = ()


class PageSession(Session, frozen=True, kw_only=True):
    """Session as a client gets it; another `kind` or `version` is another page, which loads again."""

    version: str
    """Version of the server."""
    foxglove: str
    """Address for Foxglove and Lichtblick."""
    node: str | None
    """Name of the page's node on the graph; None: there is no graph, or it is not joined yet."""
    view_only: bool
    """True if the server does nothing for this client that changes anything."""
    token: str | None
    """Token of links that allow everything; None: this client only looks."""
    view_token: str
    """Token of links that only allow looking."""

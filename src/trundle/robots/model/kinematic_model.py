"""Models: links joined by joints."""

from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.base.diagnostics import Source
from trundle.spatial import Pose

if TYPE_CHECKING:
    from .joint import Joint
    from .link import Link
    from .plugin import PluginTag


class Frame(Struct, frozen=True, kw_only=True):
    """Named frame, fixed to the element to which it is attached."""

    name: str
    at: Source
    model_from_frame: Pose = Pose()
    """Pose with every joint at zero; in the world for a frame of the world."""
    attached_to: str = "__model__"
    """Link, joint, frame or nested model of the same scope, or the model itself, as written."""


class Model(Struct, frozen=True, kw_only=True):
    """Links joined by joints, and nested models."""

    name: str
    at: Source
    world_from_model: Pose = Pose()
    """Pose in the world, or in the enclosing model's frame for a nested model."""
    static: bool = False
    self_collide: bool = False
    allow_auto_disable: bool = True
    """True if the model may sleep until a contact wakes it."""
    enable_wind: bool = False
    links: tuple["Link", ...] = ()
    joints: tuple["Joint", ...] = ()
    frames: tuple[Frame, ...] = ()
    models: tuple["Model", ...] = ()
    """Nested models; `flattened` turns their links into links of this model."""
    plugins: tuple["PluginTag", ...] = ()
    canonical_link: str | None = None
    """Link that the model's pose follows, `model::link` if nested; None without links."""
    added: bool = False
    """True if `run` added the model and no file names it."""

    def link(self, name: str) -> "Link":
        """Return a link by name, without searching nested models.

        Raises:
            KeyError: no such link; the message lists the links there are.
        """
        for link in self.links:
            if link.name == name:
                return link
        raise KeyError(f"model {self.name!r} has no link {name!r}; links here: {_quoted(self.links)}")

    def joint(self, name: str) -> "Joint":
        """Return a joint by name.

        Raises:
            KeyError: no such joint; the message lists the joints there are.
        """
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise KeyError(f"model {self.name!r} has no joint {name!r}; joints here: {_quoted(self.joints)}")


def _quoted(named: "tuple[Link, ...] | tuple[Joint, ...]") -> str:
    return ", ".join(repr(n.name) for n in named) or "none"

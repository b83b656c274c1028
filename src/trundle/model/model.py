"""Links joined by joints, placed as one."""

from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.spatial import Pose

if TYPE_CHECKING:
    from .joint import Joint
    from .link import Link
    from .plugin import PluginTag


class Frame(Struct, frozen=True, kw_only=True):
    """A named place that moves with what it is attached to."""

    name: str
    at: Source
    model_from_frame: Pose = Pose()
    """With every joint at zero; of a world's frame: in the world."""
    attached_to: str = "__model__"
    """As written: a link, joint, frame or nested model beside it, or the model itself."""


class Model(Struct, frozen=True, kw_only=True):
    """Links joined by joints, and models within the model."""

    name: str
    at: Source
    world_from_model: Pose = Pose()
    """Of a nested model: in the frame of the model around it."""
    static: bool = False
    self_collide: bool = False
    allow_auto_disable: bool = True
    """May come to rest for good until something touches it."""
    enable_wind: bool = False
    links: tuple["Link", ...] = ()
    joints: tuple["Joint", ...] = ()
    frames: tuple[Frame, ...] = ()
    models: tuple["Model", ...] = ()
    """Nested ones; `flattened` makes their links this model's."""
    plugins: tuple["PluginTag", ...] = ()
    canonical_link: str | None = None
    """The link the model's pose follows, `model::link` where it is nested; None: there is no link."""
    added: bool = False
    """Put there by `run`, not named by the file."""

    def link(self, name: str) -> "Link":
        """The link of that name, nested models aside.

        Raises:
            KeyError: with the names there are.
        """
        for link in self.links:
            if link.name == name:
                return link
        raise KeyError(f"model {self.name!r} has no link {name!r}; links here: {_quoted(self.links)}")

    def joint(self, name: str) -> "Joint":
        """The joint of that name.

        Raises:
            KeyError: with the names there are.
        """
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise KeyError(f"model {self.name!r} has no joint {name!r}; joints here: {_quoted(self.joints)}")


def _quoted(named: "tuple[Link, ...] | tuple[Joint, ...]") -> str:
    return ", ".join(repr(n.name) for n in named) or "none"

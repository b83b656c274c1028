"""Frame graph of a model or world: poses relative to other frames, resolved to the root."""

from msgspec import Struct, field

from trundle.base.diagnostics import Diagnostics, Source
from trundle.spatial import Pose

from .context import RawPose

MODEL = "__model__"
WORLD = "world"


class Scope(Struct, frozen=True):
    """Frames of a model, by the names that follow `model::` in the enclosing scope."""

    poses: dict[str, Pose]
    """model_from_frame"""
    links: dict[str, str]
    """Frame → link to which it is attached."""

    def inside(self, model: str) -> "Scope":
        """Return the scope of a nested model."""
        start = f"{model}::"
        return Scope(
            {
                k.removeprefix(start): self.poses[model].inverse() @ v
                for k, v in self.poses.items()
                if k.startswith(start)
            },
            {
                k.removeprefix(start): v.removeprefix(start)
                for k, v in self.links.items()
                if k.startswith(start) and v.startswith(start)
            },
        )


class _Entry(Struct):
    raw: RawPose
    at: Source
    default: str
    attached_to: str


class FrameGraph(Struct):
    """Graph of links, joints, <frame>s and nested models of a model or world, by name."""

    root: str
    """`__model__` or `world`."""
    report: Diagnostics
    canonical_link: str | None = None
    """Link with which frames attached to the model itself move, if it is known."""
    _entries: dict[str, _Entry] = field(default_factory=dict[str, _Entry])
    _scopes: dict[str, Scope] = field(default_factory=dict[str, Scope])
    _resolved: dict[str, Pose] = field(default_factory=dict[str, Pose])

    def add(
        self, name: str, raw: RawPose, at: Source, *, default: str | None = None, attached_to: str | None = None
    ) -> None:
        """Add a frame.

        Args:
            name: unique among its siblings.
            raw: pose as written.
            at: source position.
            default: frame of a pose without relative_to; None: the root.
            attached_to: frame to which it is fixed; None for a link.
        """
        self._entries[name] = _Entry(raw, at, default or self.root, name if attached_to is None else attached_to)

    def add_scope(self, name: str, scope: Scope) -> None:
        """Add the frames of a nested model as `name::frame`; the model itself is added by `add`."""
        self._scopes[name] = scope

    def __contains__(self, name: str) -> bool:
        return name == self.root or name in self._entries or self._scoped(name) is not None

    def names(self) -> str:
        """Return all names, for a message."""
        return ", ".join(map(repr, self._entries)) or "none"

    def pose(self, name: str) -> Pose:
        """Return root_from_frame of a known name; a broken or cyclic chain is cut with a warning."""
        chain: list[str] = []
        base = Pose()
        while name != self.root:
            if name in self._resolved:
                base = self._resolved[name]
                break
            entry = self._entries.get(name)
            if entry is None:
                scoped = self._scoped(name)
                if scoped is not None:
                    model, inner = scoped
                    base = self.pose(model) @ self._scopes[model].poses[inner]
                else:
                    last = self._entries[chain[-1]]
                    self._report_cycle(chain[-1], f"no frame {name!r}; frames here: {self.names()}", last)
                break
            if name in chain:
                self._report_cycle(chain[0], f"it is relative to itself, through {' → '.join([*chain, name])}", entry)
                break
            chain.append(name)
            name = entry.raw.relative_to or entry.default
        for frame in reversed(chain):
            base = base @ self._entries[frame].raw.pose
            self._resolved[frame] = base
        return base

    def pose_in(self, name: str, raw: RawPose, at: Source) -> Pose:
        """Return the pose in frame `name` of an element mounted on it; the raw pose may be relative to another."""
        if raw.relative_to is None:
            return raw.pose
        if raw.relative_to not in self:
            message = (
                f"no frame {raw.relative_to!r}; frames here: {self.names()}; the pose is read relative to {name!r}"
            )
            self.report.warn(raw.at or at, message, "missing-frame")
            return raw.pose
        return self.pose(name).inverse() @ self.pose(raw.relative_to) @ raw.pose

    def link(self, name: str) -> str | None:
        """Return the link to which a frame is attached; the world and the root map to themselves; None: no link."""
        visited: set[str] = set()
        while name not in (self.root, WORLD):
            if name in visited:
                return None
            visited.add(name)
            entry = self._entries.get(name)
            if entry is None or name in self._scopes:
                return self._scoped_link(name)
            if entry.attached_to == name:
                return name
            name = entry.attached_to
        return name

    def scope(self) -> Scope:
        """Return all frames for the enclosing scope; those attached to the root move with the canonical link."""
        poses = {self.root: Pose(), **{name: self.pose(name) for name in self._entries}}
        links = {name: link for name in poses if (link := self.link(name)) is not None}
        links = {name: self.canonical_link if link == self.root else link for name, link in links.items()}
        links = {name: link for name, link in links.items() if link is not None}
        for model, inner in self._scopes.items():
            for name, pose in inner.poses.items():
                poses[f"{model}::{name}"] = poses[model] @ pose
            for name, link in inner.links.items():
                links[f"{model}::{name}"] = f"{model}::{link}"
        return Scope(poses, links)

    def _scoped(self, name: str) -> tuple[str, str] | None:
        model, is_scoped, inner = name.partition("::")
        if is_scoped and model in self._scopes and inner in self._scopes[model].poses:
            return model, inner
        return None

    def _scoped_link(self, name: str) -> str | None:
        """Return the link of `model::frame`, or of a nested model by its name."""
        if name in self._scopes:
            inner = self._scopes[name].links.get(MODEL)
            return None if inner is None else f"{name}::{inner}"
        scoped = self._scoped(name)
        if scoped is None:
            return None
        model, inner = scoped
        link = self._scopes[model].links.get(inner)
        return None if link is None else f"{model}::{link}"

    def _report_cycle(self, name: str, why: str, entry: _Entry) -> None:
        self.report.warn(
            entry.raw.at or entry.at, f"frame {name!r}: {why}; {self.root} is taken instead", "missing-frame"
        )

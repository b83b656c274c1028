"""Where the frames of a model are: each is written relative to another, and the chain must end at the model."""

from dataclasses import dataclass, field

from trundle.diagnostics import DescriptionError, Source
from trundle.spatial import Pose

from .context import RawPose

MODEL = "__model__"


@dataclass(slots=True)
class FrameGraph:
    """The frames of one model: links, joints, <frame>s and nested models, by name."""

    _raw: dict[str, tuple[RawPose, str, Source]] = field(default_factory=dict[str, tuple[RawPose, str, Source]])
    _found: dict[str, Pose] = field(default_factory=dict[str, Pose])

    def add(self, name: str, raw: RawPose, at: Source, *, default: str = MODEL) -> None:
        """Add a frame.

        Args:
            name: unique among the model's links, joints, frames and models.
            raw: as written.
            at: where.
            default: what the pose is relative to where it names nothing.
        """
        self._raw[name] = (raw, default, at)

    def pose(self, name: str, at: Source) -> Pose:
        """model_from_frame.

        Raises:
            DescriptionError: no such frame, or it is written relative to itself.
        """
        if name == MODEL:
            return Pose()
        chain: list[str] = []
        while name not in self._found and name != MODEL:
            if name not in self._raw:
                there = ", ".join(map(repr, self._raw)) or "none"
                raise DescriptionError(at, f"no frame {name!r}; frames here: {there}")
            if name in chain:
                raise DescriptionError(at, f"frame {name!r} is placed relative to itself, by {' → '.join(chain)}")
            chain.append(name)
            raw, default, at = self._raw[name]
            name = raw.relative_to or default
        base = Pose() if name == MODEL else self._found[name]
        for link in reversed(chain):
            base = base @ self._raw[link][0].pose
            self._found[link] = base
        return base

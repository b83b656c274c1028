"""Checks of a lesson's steps; all but those of files are evaluated in the browser."""

from typing import Annotated, TypeAlias

import msgspec

_Distance: TypeAlias = Annotated[float, msgspec.Meta(gt=0, le=1e6)]


class _Check(msgspec.Struct, frozen=True, tag_field="check", forbid_unknown_fields=True):
    """Base of all checks."""


class FileCheck(_Check, frozen=True, tag="file"):
    """A file exists, and can be read if it is a description, launch file, program or configuration."""

    path: str
    """Path from the working folder; `~` is the home folder."""

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"file {self.path} exists and loads"


class ModelCheck(_Check, frozen=True, tag="model"):
    """A model is in the world."""

    model: str

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"model {self.model} is in the world"


class RobotCheck(_Check, frozen=True, tag="robot"):
    """The page shows a robot."""

    name: str

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"the page shows the robot {self.name}"


class SelectedCheck(_Check, frozen=True, tag="selected"):
    """A model, or a part of it, is selected."""

    model: str

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"{self.model} is selected"


class MovedCheck(_Check, frozen=True, tag="moved"):
    """A model has moved since the step began."""

    model: str
    distance: _Distance
    """[m]"""

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"{self.model} has moved {self.distance:g} m"


class FrameMovedCheck(_Check, frozen=True, tag="frame_moved"):
    """A frame of tf has moved since the step began."""

    frame: str
    reference: str
    """Frame in which the position is measured."""
    distance: _Distance
    """[m]"""

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"frame {self.frame} has moved {self.distance:g} m in {self.reference}"


class JointMovedCheck(_Check, frozen=True, tag="joint_moved"):
    """A joint has moved since the step began."""

    model: str
    joint: str
    by: _Distance
    """[rad or m]"""

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"joint {self.joint} of {self.model} has moved by {self.by:g}"


class NodeCheck(_Check, frozen=True, tag="node"):
    """A node is on the graph."""

    node: str

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"node {self.node} runs"


class PublishesCheck(_Check, frozen=True, tag="publishes"):
    """A node other than the page publishes on a topic."""

    topic: str

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"topic {self.topic} has a publisher"


class SubscribesCheck(_Check, frozen=True, tag="subscribes"):
    """A node other than the page subscribes to a topic."""

    topic: str

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"topic {self.topic} has a subscriber"


class RateCheck(_Check, frozen=True, tag="rate"):
    """Messages of a topic arrive at a rate."""

    topic: str
    hz: Annotated[float, msgspec.Meta(gt=0, le=1e6)]
    """Minimum rate [Hz]."""

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"messages of {self.topic} arrive at {self.hz:g} Hz"


class FixedFrameCheck(_Check, frozen=True, tag="fixed_frame"):
    """The displays use a fixed frame."""

    frame: str

    @property
    def sentence(self) -> str:
        """Return what is fulfilled."""
        return f"the fixed frame is {self.frame}"


Check: TypeAlias = (
    FileCheck
    | ModelCheck
    | RobotCheck
    | SelectedCheck
    | MovedCheck
    | FrameMovedCheck
    | JointMovedCheck
    | NodeCheck
    | PublishesCheck
    | SubscribesCheck
    | RateCheck
    | FixedFrameCheck
)

"""A model that has been read but not placed."""

from msgspec import Struct

from trundle.model import Model
from trundle.spatial import Pose

from .context import RawPose
from .frames import FrameGraph, Scope


class UnplacedModel(Struct, frozen=True, kw_only=True):
    """A model, its frames, and where it is to go."""

    model: Model
    scope: Scope
    raw: RawPose
    """As written."""
    placement_frame: str = ""
    """The frame of the model that is to go there; empty: the model's own."""
    merge: bool = False
    """The model dissolves into the one around it."""

    def placed(self, graph: FrameGraph) -> RawPose:
        """Where the model's own frame goes, seen from where its pose is."""
        offset = Pose()
        if self.placement_frame:
            if self.placement_frame in self.scope.poses:
                offset = self.scope.poses[self.placement_frame].inverse()
            else:
                graph.report.warn(
                    self.model.at,
                    f"placement_frame {self.placement_frame!r}: no such frame in model {self.model.name!r}; "
                    "its own frame is placed",
                )
        return RawPose(self.raw.pose @ offset, self.raw.relative_to, self.raw.at)

    def add_to(self, graph: FrameGraph) -> None:
        """Make the model and all its frames known."""
        graph.add(self.model.name, self.placed(graph), self.model.at)
        graph.add_scope(self.model.name, self.scope)

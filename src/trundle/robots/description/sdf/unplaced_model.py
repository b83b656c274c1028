"""Model whose pose is not yet resolved."""

from msgspec import Struct

from trundle.robots.model import Model
from trundle.spatial import Pose

from .context import RawPose
from .frames import FrameGraph, Scope


class UnplacedModel(Struct, frozen=True, kw_only=True):
    """Model with its frames and its target pose."""

    model: Model
    scope: Scope
    raw: RawPose
    """Pose as written."""
    placement_frame: str = ""
    """Frame of the model to place at the pose; empty: the model frame."""
    merge: bool = False
    """True to merge the model into its parent."""

    def placed(self, graph: FrameGraph) -> RawPose:
        """Return the pose of the model's own frame, relative to the same frame as the pose."""
        offset = Pose()
        if self.placement_frame:
            if self.placement_frame in self.scope.poses:
                offset = self.scope.poses[self.placement_frame].inverse()
            else:
                graph.report.warn(
                    self.model.at,
                    f"placement_frame {self.placement_frame!r}: no such frame in model {self.model.name!r}; "
                    "its own frame is placed",
                    "missing-frame",
                )
        return RawPose(self.raw.pose @ offset, self.raw.relative_to, self.raw.at)

    def add_to(self, graph: FrameGraph) -> None:
        """Add the model and all its frames to a graph."""
        graph.add(self.model.name, self.placed(graph), self.model.at)
        graph.add_scope(self.model.name, self.scope)

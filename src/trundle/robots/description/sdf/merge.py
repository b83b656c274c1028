"""Merging of an included model into its parent: <include merge="true">."""

from msgspec import Struct
from msgspec.structs import replace

from trundle.robots.model import Frame, Joint, JointAxis, Link, Model
from trundle.spatial import Pose

from .context import RawPose
from .frames import MODEL, FrameGraph
from .unplaced_model import UnplacedModel


class MergedModel(Struct, frozen=True):
    """Model whose parts are merged into the outer model or the world."""

    part: UnplacedModel
    frame: str
    """Name of the frame that replaces the frame of the merged model."""

    def merge_into(self, outer: Model, graph: FrameGraph) -> Model:
        """Return the outer model with the inner one's parts added."""
        inner = self.part.model
        turn = graph.pose(self.frame)
        frame = Frame(
            name=self.frame,
            at=inner.at,
            model_from_frame=turn,
            attached_to=inner.canonical_link or graph.root,
        )
        return replace(
            outer,
            links=(*outer.links, *(_moved(link, graph) for link in inner.links)),
            joints=(*outer.joints, *(_turned_joint(joint, turn) for joint in inner.joints)),
            frames=(*outer.frames, frame, *(_moved_frame(f, self.frame, graph) for f in inner.frames)),
            models=(*outer.models, *(_moved_model(model, graph) for model in inner.models)),
            plugins=(*outer.plugins, *inner.plugins),
        )


def merge_model(part: UnplacedModel, graph: FrameGraph) -> MergedModel:
    """Add the frames of a model to the outer graph under their own names, relative to a proxy frame for the model."""
    frame = f"_merged__{part.model.name}__model__"
    graph.add(frame, part.placed(graph), part.model.at, attached_to=part.model.canonical_link or graph.root)
    for frame_name, pose in part.scope.poses.items():
        if "::" not in frame_name and frame_name not in graph and frame_name != MODEL:
            attached_to = part.scope.links.get(frame_name, frame)
            graph.add(frame_name, RawPose(pose, frame), part.model.at, attached_to=attached_to)
    for model in part.model.models:
        graph.add_scope(model.name, part.scope.inside(model.name))
    return MergedModel(part, frame)


def _moved(link: Link, graph: FrameGraph) -> Link:
    return replace(link, model_from_link=graph.pose(link.name))


def _moved_frame(frame: Frame, model_frame: str, graph: FrameGraph) -> Frame:
    attached_to = model_frame if frame.attached_to == MODEL else frame.attached_to
    return replace(frame, model_from_frame=graph.pose(frame.name), attached_to=attached_to)


def _moved_model(model: Model, graph: FrameGraph) -> Model:
    return replace(model, world_from_model=graph.pose(model.name))


def _turned_joint(joint: Joint, turn: Pose) -> Joint:
    def turned(axis: JointAxis | None) -> JointAxis | None:
        return None if axis is None else replace(axis, direction=turn.transform_vector(axis.direction))

    return replace(joint, axis=turned(joint.axis), axis2=turned(joint.axis2))

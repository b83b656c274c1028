"""The scene as plain values."""

from typing import TYPE_CHECKING, Any

from msgspec import Struct

from trundle.planning.planning_scene import AllowedCollisionMatrix, AttachedObject, CollisionObject, PlacedShape
from trundle.spatial import Pose

from .shapes import pose_fields, shape_fields

if TYPE_CHECKING:
    from trundle.ros import Message

PARTS = {"primitives": "primitive_poses", "meshes": "mesh_poses", "planes": "plane_poses"}
"""Lists of shapes of a moveit_msgs/CollisionObject → of their poses."""


class SceneObject(Struct, frozen=True, kw_only=True, eq=False):
    """Object of the world, or one that the robot carries."""

    id: str
    pose: Pose = Pose()
    """In the model's frame; of what is carried: in the link's."""
    shapes: tuple[PlacedShape, ...] = ()
    """In the object's frame."""
    subframes: dict[str, Pose] = {}
    """Named frames of the object."""
    type_key: str = ""
    type_db: str = ""

    def fields(self, frame: str, *, operation: int = 0) -> dict[str, Any]:
        """Return the fields of a moveit_msgs/CollisionObject."""
        fields: dict[str, Any] = {
            "header": {"frame_id": frame},
            "id": self.id,
            "pose": pose_fields(self.pose),
            "type": {"key": self.type_key, "db": self.type_db},
            "subframe_names": list(self.subframes),
            "subframe_poses": [pose_fields(pose) for pose in self.subframes.values()],
            "operation": operation,
        }
        for shape in self.shapes:
            part, message = shape_fields(shape.geometry)
            fields.setdefault(part, []).append(message)
            fields.setdefault(PARTS[part], []).append(pose_fields(shape.pose))
        return fields

    def collision_object(self) -> CollisionObject:
        """Return what is checked for collisions."""
        return CollisionObject(name=self.id, shapes=self.shapes, pose=self.pose, subframes=self.subframes)


class CarriedObject(Struct, frozen=True, kw_only=True, eq=False):
    """Object attached to a link."""

    object: SceneObject
    link: str
    touch_links: tuple[str, ...] = ()
    """Links that may touch it."""
    weight: float = 0.0
    """[kg]"""
    detach_posture: "Message | None" = None
    """trajectory_msgs/JointTrajectory."""

    def fields(self) -> dict[str, Any]:
        """Return the fields of a moveit_msgs/AttachedCollisionObject."""
        fields: dict[str, Any] = {
            "link_name": self.link,
            "object": self.object.fields(self.link),
            "touch_links": list(self.touch_links),
            "weight": self.weight,
        }
        if self.detach_posture is not None:
            fields["detach_posture"] = self.detach_posture
        return fields

    def attached_object(self) -> AttachedObject:
        """Return what is checked for collisions."""
        item = self.object.collision_object()
        return AttachedObject(object=item, link=self.link, touch_links=frozenset(self.touch_links))


class SceneContents:
    """All of the scene but the robot's positions."""

    def __init__(self, name: str, allowed: AllowedCollisionMatrix) -> None:
        """Begin with an empty world."""
        self.name = name
        self.objects: dict[str, SceneObject] = {}
        self.carried: dict[str, CarriedObject] = {}
        self.allowed = allowed
        self.padding: dict[str, float] = {}
        """Link → distance that it is kept from others [m]."""
        self.scale: dict[str, float] = {}
        self.colors: dict[str, tuple[float, float, float, float]] = {}
        self.octomap: Message | None = None
        """octomap_msgs/OctomapWithPose."""

    def copy(self) -> "SceneContents":
        """Return an independent copy; what is in it is immutable."""
        other = SceneContents(self.name, self.allowed.copy())
        other.objects, other.carried = dict(self.objects), dict(self.carried)
        other.padding, other.scale, other.colors = dict(self.padding), dict(self.scale), dict(self.colors)
        other.octomap = self.octomap
        return other

"""Objects around the robot, and attached to it."""

from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import Pose
from moveit_msgs.msg import (
    AllowedCollisionEntry,
    AllowedCollisionMatrix,
    AttachedCollisionObject,
    CollisionObject,
    PlanningScene,
)
from moveit_msgs.srv import ApplyPlanningScene
from shape_msgs.msg import Plane, SolidPrimitive

import rospy
from moveit_ros_planning_interface import _moveit_planning_scene_interface
from moveit_ros_planning_interface.robot_state import in_namespace
from moveit_ros_planning_interface.serialization import from_bytes, to_bytes

from .mesh_files import read_mesh

_Size = Sequence[float]


class PlanningSceneInterface:
    """Adds, moves, attaches and removes objects in move_group's planning scene."""

    def __init__(self, ns: str = "", synchronous: bool = True) -> None:
        """Connect to a namespace; `synchronous`: each change returns when it is applied, otherwise it is published."""
        self._psi = _moveit_planning_scene_interface.PlanningSceneInterface(ns, wait=synchronous)
        self._is_synchronous = synchronous
        if synchronous:
            self._apply_planning_scene_diff: Any = rospy.ServiceProxy(
                in_namespace(ns, "apply_planning_scene"), ApplyPlanningScene
            )
        else:
            self._pub_co = rospy.Publisher(in_namespace(ns, "collision_object"), CollisionObject, queue_size=100)
            self._pub_aco = rospy.Publisher(
                in_namespace(ns, "attached_collision_object"), AttachedCollisionObject, queue_size=100
            )

    def _submit(self, item: Any, *, attach: bool = False) -> None:
        if not self._is_synchronous:
            (self._pub_aco if attach else self._pub_co).publish(item)
            return
        scene: Any = PlanningScene()
        scene.is_diff = scene.robot_state.is_diff = True
        if attach:
            scene.robot_state.attached_collision_objects = [item]
        else:
            scene.world.collision_objects = [item]
        try:
            self._apply_planning_scene_diff(scene)
        except rospy.ServiceException as error:
            rospy.logwarn(f"Failed to call ApplyPlanningScene service: {error}")

    # -- objects of the world

    def add_object(self, collision_object: Any) -> None:
        """Add a moveit_msgs/CollisionObject."""
        self._submit(collision_object)

    def add_sphere(self, name: str, pose: Any, radius: float = 1) -> None:
        """Add a sphere at a geometry_msgs/PoseStamped [m]."""
        self._submit(self.make_sphere(name, pose, radius))

    def add_cylinder(self, name: str, pose: Any, height: float, radius: float) -> None:
        """Add a cylinder along z at a geometry_msgs/PoseStamped [m]."""
        self._submit(self.make_cylinder(name, pose, height, radius))

    def add_cone(self, name: str, pose: Any, height: float, radius: float) -> None:
        """Add a cone along z at a geometry_msgs/PoseStamped [m]."""
        self._submit(self.make_cone(name, pose, height, radius))

    def add_mesh(self, name: str, pose: Any, filename: str, size: _Size = (1, 1, 1)) -> None:
        """Add a mesh file (.stl, .dae, .obj, .glb) at a geometry_msgs/PoseStamped, scaled along its axes."""
        self._submit(self.make_mesh(name, pose, filename, size))

    def add_box(self, name: str, pose: Any, size: _Size = (1, 1, 1)) -> None:
        """Add a box at a geometry_msgs/PoseStamped [m]."""
        self._submit(self.make_box(name, pose, size))

    def add_plane(self, name: str, pose: Any, normal: _Size = (0, 0, 1), offset: float = 0) -> None:
        """Add the plane normal · x + offset = 0 in the frame of a geometry_msgs/PoseStamped."""
        self._submit(self.make_plane(name, pose, normal, offset))

    def remove_world_object(self, name: str | None = None) -> None:
        """Remove an object, or all."""
        item: Any = CollisionObject()
        item.operation, item.id = CollisionObject.REMOVE, name or ""
        self._submit(item)

    def clear(self) -> None:
        """Remove all objects, and what is attached."""
        self._psi.clear()

    # -- attached objects

    def attach_object(self, object: Any, link: str | None = None, touch_links: Sequence[str] | None = None) -> None:
        """Attach a moveit_msgs/AttachedCollisionObject or CollisionObject, or an object of the scene by its name."""
        if isinstance(object, str):
            object = CollisionObject(id=object)
        if isinstance(object, CollisionObject):
            object = AttachedCollisionObject(object=object)
        attached: Any = object
        if link is not None:
            attached.link_name = link
        attached.touch_links = [attached.link_name] if touch_links is None else list(touch_links)
        self._submit(attached, attach=True)

    def attach_mesh(
        self,
        link: str,
        name: str,
        pose: Any = None,
        filename: str = "",
        size: _Size = (1, 1, 1),
        touch_links: Sequence[str] | None = None,
    ) -> None:
        """Attach a mesh file; without a pose or file, the object of the scene."""
        item = name if pose is None or not filename else self.make_mesh(name, pose, filename, size)
        self.attach_object(item, link, touch_links)

    def attach_box(
        self,
        link: str,
        name: str,
        pose: Any = None,
        size: _Size = (1, 1, 1),
        touch_links: Sequence[str] | None = None,
    ) -> None:
        """Attach a box; without a pose, the object of the scene."""
        self.attach_object(name if pose is None else self.make_box(name, pose, size), link, touch_links)

    def attach_sphere(
        self, link: str, name: str, pose: Any = None, radius: float = 1, touch_links: Sequence[str] | None = None
    ) -> None:
        """Attach a sphere; without a pose, the object of the scene."""
        self.attach_object(name if pose is None else self.make_sphere(name, pose, radius), link, touch_links)

    def attach_cylinder(
        self,
        link: str,
        name: str,
        pose: Any = None,
        height: float = 1,
        radius: float = 1,
        touch_links: Sequence[str] | None = None,
    ) -> None:
        """Attach a cylinder; without a pose, the object of the scene."""
        item = name if pose is None else self.make_cylinder(name, pose, height, radius)
        self.attach_object(item, link, touch_links)

    def remove_attached_object(self, link: str | None = None, name: str | None = None) -> None:
        """Detach an object, or all of a link, or all; they stay in the world."""
        attached: Any = AttachedCollisionObject()
        attached.object.operation = CollisionObject.REMOVE
        attached.link_name, attached.object.id = link or "", name or ""
        self._submit(attached, attach=True)

    # -- what there is

    def get_known_object_names(self, with_type: bool = False) -> list[str]:
        """Return the names of the world's objects; `with_type`: only of those with a type."""
        return self._psi.get_known_object_names(with_type)

    def get_known_object_names_in_roi(
        self, minx: float, miny: float, minz: float, maxx: float, maxy: float, maxz: float, with_type: bool = False
    ) -> list[str]:
        """Return the names of the objects inside a box of the planning frame [m]."""
        return self._psi.get_known_object_names_in_roi(minx, miny, minz, maxx, maxy, maxz, with_type)

    def get_object_poses(self, object_ids: Sequence[str]) -> dict[str, Any]:
        """Return geometry_msgs/Pose by name."""
        return {name: from_bytes(Pose, data) for name, data in self._psi.get_object_poses(object_ids).items()}

    def get_objects(self, object_ids: Sequence[str] = ()) -> dict[str, Any]:
        """Return moveit_msgs/CollisionObject by name; without names, all."""
        return {name: from_bytes(CollisionObject, data) for name, data in self._psi.get_objects(object_ids).items()}

    def get_attached_objects(self, object_ids: Sequence[str] = ()) -> dict[str, Any]:
        """Return moveit_msgs/AttachedCollisionObject by name; without names, all."""
        found = self._psi.get_attached_objects(object_ids)
        return {name: from_bytes(AttachedCollisionObject, data) for name, data in found.items()}

    def get_planning_scene(self, components: int) -> Any:
        """Return the moveit_msgs/PlanningScene with the components asked for."""
        return from_bytes(PlanningScene, self._psi.get_planning_scene(components))

    def apply_planning_scene(self, planning_scene_message: Any) -> bool:
        """Apply a moveit_msgs/PlanningScene; True when it is applied."""
        return self._psi.apply_planning_scene(to_bytes(planning_scene_message))

    # -- moveit_msgs/CollisionObject

    @staticmethod
    def _make_primitive(name: str, pose: Any, kind: int, dimensions: Sequence[float]) -> Any:
        shape: Any = SolidPrimitive()
        shape.type, shape.dimensions = kind, [float(number) for number in dimensions]
        item = _object(name, pose)
        item.primitives = [shape]
        return item

    @staticmethod
    def make_box(name: str, pose: Any, size: _Size) -> Any:
        """Return a box [m]."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.BOX, size)

    @staticmethod
    def make_sphere(name: str, pose: Any, radius: float) -> Any:
        """Return a sphere [m]."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.SPHERE, [radius])

    @staticmethod
    def make_cylinder(name: str, pose: Any, height: float, radius: float) -> Any:
        """Return a cylinder along z [m]."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.CYLINDER, [height, radius])

    @staticmethod
    def make_cone(name: str, pose: Any, height: float, radius: float) -> Any:
        """Return a cone along z [m]."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.CONE, [height, radius])

    @staticmethod
    def make_mesh(name: str, pose: Any, filename: str, scale: _Size = (1, 1, 1)) -> Any:
        """Return the triangles of a mesh file."""
        item = _object(name, pose)
        item.meshes = [read_mesh(filename, scale)]
        return item

    @staticmethod
    def make_plane(name: str, pose: Any, normal: _Size = (0, 0, 1), offset: float = 0) -> Any:
        """Return the plane normal · x + offset = 0."""
        plane: Any = Plane()
        plane.coef = [*map(float, normal), float(offset)]
        item: Any = CollisionObject()
        item.operation, item.id, item.header = CollisionObject.ADD, name, pose.header
        item.planes, item.plane_poses = [plane], [pose.pose]
        return item


def _object(name: str, pose: Any) -> Any:
    item: Any = CollisionObject()
    item.operation, item.id = CollisionObject.ADD, name
    item.header, item.pose = pose.header, pose.pose
    return item


def acm_set_default(acm: Any, obj: str, allow: bool) -> None:
    """Allow or check collisions of an object with everything, as AllowedCollisionMatrix.set_default."""
    acm.default_entry_names, acm.default_entry_values = list(acm.default_entry_names), list(acm.default_entry_values)
    if obj in acm.default_entry_names:
        acm.default_entry_values[acm.default_entry_names.index(obj)] = allow
    else:
        acm.default_entry_names.append(obj)
        acm.default_entry_values.append(allow)


def acm_set_allowed(acm: Any, obj: str, other: str | None = None, allow: bool = True) -> None:
    """Allow or check collisions of an object with another, as AllowedCollisionMatrix.set_allowed."""
    if other is None:
        acm_set_default(acm, obj, allow)
        return
    if obj not in acm.entry_names:
        for entry in acm.entry_values:
            entry.enabled = [*entry.enabled, False]
        acm.entry_names = [*acm.entry_names, obj]
        entry = AllowedCollisionEntry(enabled=[False] * len(acm.entry_names))
        acm.entry_values = [*acm.entry_values, entry]
    first, second = acm.entry_names.index(obj), acm.entry_names.index(other)
    for row, column in ((first, second), (second, first)):
        enabled = list(acm.entry_values[row].enabled)
        enabled[column] = allow
        acm.entry_values[row].enabled = enabled


AllowedCollisionMatrix.set_default = acm_set_default
AllowedCollisionMatrix.set_allowed = acm_set_allowed

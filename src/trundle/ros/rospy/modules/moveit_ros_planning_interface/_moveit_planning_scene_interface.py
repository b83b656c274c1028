"""move_group's planning scene: objects, attached objects, changes."""

from collections.abc import Sequence
from typing import Any

from moveit_msgs.msg import CollisionObject, PlanningScene, PlanningSceneComponents
from moveit_msgs.srv import ApplyPlanningScene, GetPlanningScene

import rospy

from ._moveit_roscpp_initializer import ensure_node
from .robot_state import in_namespace
from .serialization import from_bytes, to_bytes


class PlanningSceneInterface:
    """Asks for the scene, and changes it; blocks until move_group's services are there."""

    def __init__(self, ns: str = "", wait: bool = True) -> None:
        """Connect to the services of a namespace."""
        ensure_node()
        names = [in_namespace(ns, name) for name in ("get_planning_scene", "apply_planning_scene")]
        if wait:
            for name in names:
                rospy.wait_for_service(name)
        self._get: Any = rospy.ServiceProxy(names[0], GetPlanningScene)
        self._apply: Any = rospy.ServiceProxy(names[1], ApplyPlanningScene)

    def _scene(self, components: int) -> Any:
        request: Any = PlanningSceneComponents()
        request.components = components
        try:
            return self._get(request).scene
        except rospy.ServiceException as error:
            rospy.logwarn(f"Could not call planning scene service to get the objects: {error}")
            return PlanningScene()

    def _objects(self) -> list[Any]:
        return self._scene(PlanningSceneComponents.WORLD_OBJECT_GEOMETRY).world.collision_objects

    def get_known_object_names(self, with_type: bool = False) -> list[str]:
        """Return the names of the world's objects."""
        return [item.id for item in self._objects() if not with_type or item.type.key]

    def get_known_object_names_in_roi(
        self, minx: float, miny: float, minz: float, maxx: float, maxy: float, maxz: float, with_type: bool = False
    ) -> list[str]:
        """Return the names of the objects all of whose parts have their origins in a box [m]."""

        def is_inside(item: Any) -> bool:
            poses = [*item.primitive_poses, *item.mesh_poses]
            return bool(poses) and all(
                minx <= item.pose.position.x + pose.position.x <= maxx
                and miny <= item.pose.position.y + pose.position.y <= maxy
                and minz <= item.pose.position.z + pose.position.z <= maxz
                for pose in poses
            )

        return [item.id for item in self._objects() if is_inside(item) and (not with_type or item.type.key)]

    def get_object_poses(self, object_ids: Sequence[str]) -> dict[str, bytes]:
        """Return the serialized poses of objects by name."""
        return {item.id: to_bytes(item.pose) for item in self._objects() if item.id in object_ids}

    def get_objects(self, object_ids: Sequence[str] = ()) -> dict[str, bytes]:
        """Return the serialized objects by name; without names, all."""
        return {item.id: to_bytes(item) for item in self._objects() if not object_ids or item.id in object_ids}

    def get_attached_objects(self, object_ids: Sequence[str] = ()) -> dict[str, bytes]:
        """Return the serialized attached objects by name; without names, all."""
        attached = self._scene(PlanningSceneComponents.ROBOT_STATE_ATTACHED_OBJECTS).robot_state
        return {
            item.object.id: to_bytes(item)
            for item in attached.attached_collision_objects
            if not object_ids or item.object.id in object_ids
        }

    def get_planning_scene(self, components: int) -> bytes:
        """Return the serialized moveit_msgs/PlanningScene with the components asked for."""
        return to_bytes(self._scene(components))

    def apply_planning_scene(self, scene: bytes) -> bool:
        """Apply a serialized moveit_msgs/PlanningScene; returns when it is applied."""
        try:
            return bool(self._apply(from_bytes(PlanningScene, scene)).success)
        except rospy.ServiceException as error:
            rospy.logwarn(f"Failed to call ApplyPlanningScene service: {error}")
            return False

    def clear(self) -> bool:
        """Remove all objects, and detach what is attached."""
        scene: Any = PlanningScene()
        scene.is_diff = scene.robot_state.is_diff = True
        removal: Any = CollisionObject()
        removal.operation = CollisionObject.REMOVE
        scene.world.collision_objects = [removal]
        attached = self._scene(PlanningSceneComponents.ROBOT_STATE_ATTACHED_OBJECTS).robot_state
        for item in attached.attached_collision_objects:
            item.object.operation = CollisionObject.REMOVE
            scene.robot_state.attached_collision_objects.append(item)
        return self.apply_planning_scene(to_bytes(scene))

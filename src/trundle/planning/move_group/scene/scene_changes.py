"""Changes of the scene by messages, with the original's rules."""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError
from trundle.planning.planning_scene import AllowedCollisionMatrix, PlacedShape, ShapeGeometry
from trundle.spatial import Pose

from .frames import Frames
from .scene_contents import CarriedObject, SceneContents, SceneObject
from .shapes import mesh_of, plane_of, pose_of, primitive_of

if TYPE_CHECKING:
    from trundle.ros import Message

ADD, REMOVE, APPEND, MOVE = 0, 1, 2, 3
"""Operations of moveit_msgs/CollisionObject."""
_MAX_OBJECTS = 10_000
_MAX_SHAPES = 10_000
_MAX_NAMES = 5000
_IDENTITY = Pose()


class SceneError(TrundleError):
    """A change that does not fit the scene."""


class SceneChanges:
    """Applies messages to contents; an invalid one changes nothing and raises."""

    def __init__(self, contents: SceneContents, frames: Frames, links: Callable[[str], bool]) -> None:
        """Hold what is changed.

        Args:
            contents: changed in place.
            frames: at the robot's present state.
            links: True for the names of links.
        """
        self._contents = contents
        self._frames = frames
        self._is_link = links

    def apply_scene(self, message: "Message") -> None:
        """Apply a moveit_msgs/PlanningScene: a diff, or all of the world.

        Raises:
            SceneError: a part is invalid; the others are applied.
            FrameError: a frame is unknown.
        """
        contents = self._contents
        is_diff = bool(message.is_diff)
        if message.name:
            contents.name = str(message.name)
        if not is_diff:
            contents.objects.clear()
            contents.octomap = None
        matrix = message.allowed_collision_matrix
        if len(matrix.entry_names) or len(matrix.default_entry_names):
            contents.allowed = _matrix(matrix)
        contents.padding.update({str(one.link_name): max(0.0, float(one.padding)) for one in message.link_padding})
        contents.scale.update({str(one.link_name): float(one.scale) for one in message.link_scale})
        for one in message.object_colors:
            c = one.color
            contents.colors[str(one.id)] = (float(c.r), float(c.g), float(c.b), float(c.a))
        self.apply_state_objects(message.robot_state, is_diff=is_diff)
        for item in message.world.collision_objects:
            self.apply_object(item)
        self.apply_octomap(message.world.octomap)

    def apply_state_objects(self, state: "Message", *, is_diff: bool) -> None:
        """Attach what a moveit_msgs/RobotState carries; unless it is a diff, only that.

        Raises:
            SceneError: an object is invalid.
            FrameError: a frame is unknown.
        """
        if not is_diff and not state.is_diff:
            self._contents.carried.clear()
        for item in state.attached_collision_objects:
            self.apply_attached(item)

    def apply_octomap(self, message: "Message") -> None:
        """Take an octomap_msgs/OctomapWithPose; an empty one without id changes nothing."""
        if len(message.octomap.data):
            self._contents.octomap = message
        elif message.octomap.id:
            self._contents.octomap = None

    # -- objects of the world

    def apply_object(self, message: "Message") -> None:
        """Add, extend, move or remove an object.

        Raises:
            SceneError: the object is invalid, or not there.
            FrameError: its frame is unknown.
        """
        contents, name = self._contents, str(message.id)
        operation = int(message.operation)
        if operation == REMOVE:
            if not name:
                contents.objects.clear()
            elif contents.objects.pop(name, None) is None and name not in contents.carried:
                raise SceneError(f"Tried to remove world object '{name}', but it does not exist in this scene.")
            contents.colors.pop(name, None)
        elif operation == MOVE:
            self._move(message)
        elif operation in (ADD, APPEND):
            added = self._read(message)
            if not added.shapes:
                raise SceneError(f"There are no shapes specified in the collision object message '{name}'")
            old = contents.objects.get(name)
            if operation == APPEND and old is not None:
                shapes = _placed(added.shapes, old.pose.inverse() @ added.pose)
                added = SceneObject(
                    id=name,
                    pose=old.pose,
                    shapes=(*old.shapes, *shapes),
                    subframes={**old.subframes, **added.subframes},
                    type_key=old.type_key,
                    type_db=old.type_db,
                )
            if len(contents.objects) >= _MAX_OBJECTS and name not in contents.objects:
                raise SceneError(f"more than {_MAX_OBJECTS} objects; '{name}' is not added")
            contents.objects[name] = added
        else:
            raise SceneError(f"Unknown collision object operation: {operation}")

    def _move(self, message: "Message") -> None:
        name = str(message.id)
        old = self._contents.objects.get(name)
        if old is None:
            known = ", ".join(self._contents.objects) or "none"
            raise SceneError(f"World object '{name}' does not exist. Cannot move; objects: {known}.")
        moved = self._read(message)
        shapes = old.shapes
        if moved.shapes or len(message.primitive_poses) + len(message.mesh_poses) + len(message.plane_poses) > 1:
            poses = [
                pose_of(one) for part in ("primitive", "mesh", "plane") for one in getattr(message, f"{part}_poses")
            ]
            if len(poses) == len(old.shapes) and len(poses) > 1:
                shapes = tuple(PlacedShape(one.geometry, pose) for one, pose in zip(old.shapes, poses, strict=True))
        self._contents.objects[name] = SceneObject(
            id=name,
            pose=moved.pose,
            shapes=shapes,
            subframes=old.subframes,
            type_key=old.type_key,
            type_db=old.type_db,
        )

    def _read(self, message: "Message", *, into: Pose = _IDENTITY) -> SceneObject:
        """Read an object in the model's frame, or in one of pose `into`.

        Raises:
            SceneError: the object is invalid.
            FrameError: its frame is unknown.
        """
        name = str(message.id)
        if not name:
            raise SceneError("a collision object needs an id")
        frame_from_header = into.inverse() @ self._frames.find(str(message.header.frame_id))
        try:
            shapes = _shapes(message)
            pose = pose_of(message.pose)
            subframes = {
                str(key): pose_of(one) for key, one in zip(message.subframe_names, message.subframe_poses, strict=False)
            }
        except ValueError as error:
            raise SceneError(f"collision object '{name}': {error}") from None
        lone = [pose_of(p) for k in ("primitive", "mesh", "plane") for p in getattr(message, f"{k}_poses")]
        if pose == Pose() and len(lone) == 1:
            # As in the original: the pose of the only shape is the object's.
            pose, shapes = lone[0], _placed(shapes, lone[0].inverse())
        return SceneObject(
            id=name,
            pose=frame_from_header @ pose,
            shapes=shapes,
            subframes=subframes,
            type_key=str(message.type.key),
            type_db=str(message.type.db),
        )

    # -- what the robot carries

    def apply_attached(self, message: "Message") -> None:
        """Attach an object to a link, or detach it.

        Raises:
            SceneError: the object or link is not there.
            FrameError: a frame is unknown.
        """
        operation = int(message.object.operation)
        if operation == REMOVE:
            self._detach(str(message.object.id), str(message.link_name))
            return
        if operation not in (ADD, APPEND):
            raise SceneError(f"Unknown collision object operation: {operation}")
        name, link = str(message.object.id), str(message.link_name)
        if not self._is_link(link):
            raise SceneError(f"Robot state is not compatible with robot model: there is no link '{link}' for '{name}'")
        model_from_link = self._frames.find(link)
        contents = self._contents
        count = len(message.object.primitives) + len(message.object.meshes) + len(message.object.planes)
        if count == 0:
            carried = self._from_world(name, link, model_from_link)
        else:
            carried = self._read(message.object, into=model_from_link)
            contents.objects.pop(name, None)
        old = contents.carried.get(name)
        if operation == APPEND and old is not None and old.link == link:
            carried = SceneObject(
                id=name,
                pose=old.object.pose,
                shapes=(*old.object.shapes, *_placed(carried.shapes, old.object.pose.inverse() @ carried.pose)),
                subframes={**old.object.subframes, **carried.subframes},
                type_key=old.object.type_key,
                type_db=old.object.type_db,
            )
        posture = message.detach_posture
        contents.carried[name] = CarriedObject(
            object=carried,
            link=link,
            touch_links=tuple(dict.fromkeys((link, *(str(one) for one in message.touch_links)))),
            weight=float(message.weight),
            detach_posture=posture if len(posture.joint_names) else None,
        )

    def _from_world(self, name: str, link: str, model_from_link: Pose) -> SceneObject:
        """Take an object of the world, or one that another link carries."""
        contents = self._contents
        found = contents.objects.pop(name, None)
        if found is None:
            held = contents.carried.get(name)
            if held is None:
                known = ", ".join(contents.objects) or "none"
                raise SceneError(
                    f"Attempting to attach object '{name}' to link '{link}' but no geometry specified and such an "
                    f"object does not exist in the collision world; objects: {known}"
                )
            found = _moved(held.object, self._frames.find(held.link) @ held.object.pose)
        return _moved(found, model_from_link.inverse() @ found.pose)

    def _detach(self, name: str, link: str) -> None:
        contents = self._contents
        chosen = [
            key
            for key, carried in contents.carried.items()
            if (not name or key == name) and (not link or carried.link == link)
        ]
        if name and not chosen:
            known = ", ".join(contents.carried) or "none"
            raise SceneError(f"No object named '{name}' is attached to the robot; attached objects: {known}")
        for key in chosen:
            carried = contents.carried.pop(key)
            contents.objects[key] = _moved(carried.object, self._frames.link(carried.link) @ carried.object.pose)


def _moved(item: SceneObject, pose: Pose) -> SceneObject:
    return SceneObject(
        id=item.id,
        pose=pose,
        shapes=item.shapes,
        subframes=item.subframes,
        type_key=item.type_key,
        type_db=item.type_db,
    )


def _placed(shapes: Iterable[PlacedShape], pose: Pose) -> tuple[PlacedShape, ...]:
    return tuple(PlacedShape(shape.geometry, pose @ shape.pose) for shape in shapes)


def _matrix(message: "Message") -> AllowedCollisionMatrix:
    """Read a moveit_msgs/AllowedCollisionMatrix.

    Raises:
        SceneError: it is not square, or too large.
    """
    names = [str(name) for name in message.entry_names]
    if len(names) > _MAX_NAMES:
        raise SceneError(f"an allowed collision matrix of {len(names)} names; at most {_MAX_NAMES} are accepted")
    rows = [[bool(flag) for flag in entry.enabled] for entry in message.entry_values]
    if len(rows) != len(names) or any(len(row) != len(names) for row in rows):
        raise SceneError(
            f"Number of links does not match number of entries in AllowedCollisionMatrix message: {len(names)} names, "
            f"{len(rows)} rows"
        )
    defaults = zip(message.default_entry_names, message.default_entry_values, strict=False)
    return AllowedCollisionMatrix.of_matrix(names, rows, {str(name): bool(value) for name, value in defaults})


def _shapes(message: "Message") -> tuple[PlacedShape, ...]:
    """Read all shapes with their poses.

    Raises:
        ValueError: a shape is invalid, or there are more poses than shapes.
    """
    shapes: list[PlacedShape] = []
    readers: dict[str, Callable[[Any], tuple[ShapeGeometry, Pose]]] = {
        "primitive": lambda one: (primitive_of(one), Pose()),
        "mesh": lambda one: (mesh_of(one), Pose()),
        "plane": plane_of,
    }
    for part, read in readers.items():
        items = getattr(message, {"primitive": "primitives", "mesh": "meshes", "plane": "planes"}[part])
        poses = getattr(message, f"{part}_poses")
        if items and len(poses) > len(items):
            raise ValueError(f"Number of {part} shapes ({len(items)}) does not match number of poses ({len(poses)})")
        if len(shapes) + len(items) > _MAX_SHAPES:
            raise ValueError(f"more than {_MAX_SHAPES} shapes")
        for index, item in enumerate(items):
            geometry, offset = read(item)
            pose = pose_of(poses[index]) if index < len(poses) else Pose()
            shapes.append(PlacedShape(geometry, pose @ offset))
    return tuple(shapes)

"""The scene that everything plans in: changed by topics and services, published as it changes."""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.planning.planning_scene import AllowedCollisionMatrix
from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from .current_state_monitor import CurrentStateMonitor
from .robot_description import RobotDescription
from .scene import (
    Frames,
    SceneChanges,
    SceneContents,
    diff_fields,
    is_empty_state,
    positions_of,
    scene_fields,
)

if TYPE_CHECKING:
    from trundle.planning.kinematics import Kinematics
    from trundle.ros import Message

_LOOK_S = 0.02


class MonitorSettings(msgspec.Struct, kw_only=True):
    """Parameters of ~planning_scene_monitor, with the original's defaults."""

    publish_planning_scene: bool = False
    publish_geometry_updates: bool = False
    publish_state_updates: bool = False
    publish_transforms_updates: bool = False
    publish_planning_scene_hz: float = 4.0


class PlanningSceneMonitor:
    """Scene and robot state; all on the loop."""

    def __init__(
        self,
        node: Node,
        description: RobotDescription,
        kinematics: "Kinematics",
        buffer: TransformBuffer,
        settings: MonitorSettings,
    ) -> None:
        """Subscribe to what changes the scene.

        Args:
            node: move_group.
            description: robot.
            kinematics: of its model.
            buffer: tf.
            settings: what is published, and how often.
        """
        self._node = node
        self.model = description.model
        self.kinematics = kinematics
        self.buffer = buffer
        self.settings = settings
        self.state = CurrentStateMonitor(node, description.model, buffer)
        self.contents = _initial(description)
        self._published: SceneContents | None = None
        self._is_state_new = False
        self.changes = 0
        """Number of changes of the world so far; motions look whether they are still free."""
        self.state.on_update.append(self._note_state)
        for topic, kind, receive in (
            ("planning_scene", "PlanningScene", self._on_scene),
            ("planning_scene_world", "PlanningSceneWorld", self._on_world),
            ("collision_object", "CollisionObject", self._on_object),
            ("attached_collision_object", "AttachedCollisionObject", self._on_attached),
        ):
            node.subscribe(topic, f"moveit_msgs/{kind}", receive, queue_size=1024, on_loop=True)
            node.log.info(f"Listening to '{node.resolve(topic)}'")
        self._publisher = node.advertise(
            "~monitored_planning_scene",
            "moveit_msgs/PlanningScene",
            queue_size=100,
            on_connect=lambda _: self._publish_all(),
        )
        node.log.info(f"Publishing maintained planning scene on '{node.resolve('~monitored_planning_scene')}'")

    # -- what it knows

    def positions(self) -> np.ndarray:
        """Return the present state vector."""
        return self.state.positions()

    async def start_positions(self, state: "Message") -> np.ndarray:
        """Return the state that a moveit_msgs/RobotState means, over the present one.

        Raises:
            ValueError: the state is invalid.
        """
        if is_empty_state(state) or state.is_diff:
            await self.state.wait_since(self._node.clock.now_ns())
        return positions_of(self.model, state, self.positions())

    def frames(self, positions: np.ndarray | None = None, contents: SceneContents | None = None) -> Frames:
        """Return the frames at a state and scene, by default the present ones."""
        state = self.positions() if positions is None else positions
        return Frames(self.model, self.kinematics, state, contents or self.contents, self.buffer)

    def fields(self, components: int) -> dict[str, Any]:
        """Return the fields of a moveit_msgs/PlanningScene; no components: all."""
        stamp_ns = self.state.stamp_ns()
        return scene_fields(
            self.model, self.contents, self.positions(), stamp_ns=stamp_ns, components=components or 1023
        )

    # -- what changes it

    def apply(self, scene: "Message") -> bool:
        """Apply a moveit_msgs/PlanningScene; False with a sentence in the log if a part of it is invalid."""
        return self._change(lambda changes: changes.apply_scene(scene))

    def changed_contents(self, scene: "Message") -> SceneContents:
        """Return a copy of the scene with a moveit_msgs/PlanningScene applied.

        Raises:
            TrundleError: a part of it is invalid.
        """
        contents = self.contents.copy()
        SceneChanges(contents, self.frames(contents=contents), self.model.has_link).apply_scene(scene)
        return contents

    def _change(self, act: Callable[[SceneChanges], None]) -> bool:
        contents = self.contents.copy()
        is_valid = True
        try:
            act(SceneChanges(contents, self.frames(contents=contents), self.model.has_link))
        except TrundleError as error:
            self._node.log.error(str(error))
            is_valid = False
        self.contents = contents
        self.changes += 1
        return is_valid

    def replace(self, contents: SceneContents) -> None:
        """Take other contents."""
        self.contents = contents
        self.changes += 1

    def clear_octomap(self) -> None:
        """Forget the occupied space."""
        contents = self.contents.copy()
        contents.octomap = None
        self.replace(contents)

    def _on_scene(self, message: "Message") -> None:
        self.apply(message)

    def _on_world(self, message: "Message") -> None:
        def act(changes: SceneChanges) -> None:
            for item in message.collision_objects:
                changes.apply_object(item)
            changes.apply_octomap(message.octomap)

        self._change(act)

    def _on_object(self, message: "Message") -> None:
        self._change(lambda changes: changes.apply_object(message))

    def _on_attached(self, message: "Message") -> None:
        self._change(lambda changes: changes.apply_attached(message))

    # -- what is published

    def _note_state(self) -> None:
        self._is_state_new = True

    def _publish_all(self) -> None:
        self._published = self.contents
        self._publisher.publish(self.fields(0))

    async def publish_changes(self) -> None:
        """Publish diffs until cancelled: the world's as they come, the robot's at most at the rate set."""
        clock, settings = self._node.clock, self.settings
        period_s = 1.0 / max(settings.publish_planning_scene_hz, 0.1)
        while not self._node.closed.is_set():
            await clock.sleep(period_s)
            if not self._publisher.has_subscribers:
                continue
            old, new = self._published, self.contents
            if old is None:
                self._publish_all()
            elif old is not new or self._is_state_new:
                self._is_state_new = False
                self._published = new
                fields = diff_fields(self.model, old, new, self.positions(), stamp_ns=self.state.stamp_ns())
                self._publisher.publish(fields)


def _initial(description: RobotDescription) -> SceneContents:
    """Return the empty scene: collisions as in the SRDF, paddings and operations as in NAME_planning."""
    model = description.model
    colliding = [link.name for link in model.urdf.links if link.collisions]
    allowed = AllowedCollisionMatrix.of_model(model)
    for index, name in enumerate(colliding):  # each link has a row, which programs look for
        for other in colliding[:index]:
            if allowed.entry(name, other) is None:
                allowed.set_entry(name, other, False)
    contents = SceneContents("(noname)", allowed)
    planning = RosParameters(description.planning, f"{description.name}_planning")
    default = planning.number("default_robot_padding", 0.0)
    contents.padding = dict.fromkeys(colliding, default)
    contents.scale = dict.fromkeys(colliding, planning.number("default_robot_scale", 1.0))
    contents.padding.update(_numbers(planning.section("default_robot_link_padding")))
    contents.scale.update(_numbers(planning.section("default_robot_link_scale")))
    for entry in planning.sections("default_collision_operations"):
        operation = entry.text("operation", "")
        first, second = entry.text("object1", ""), entry.text("object2", "")
        if operation in ("disable", "enable") and first and second:
            contents.allowed.set_entry(first, second, operation == "disable")
    return contents


def _numbers(section: RosParameters) -> Iterable[tuple[str, float]]:
    return [(name, section.number(name, 0.0)) for name in section.names()]

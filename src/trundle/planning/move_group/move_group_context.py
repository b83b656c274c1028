"""What move_group's capabilities share."""

from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct

from trundle.ros import Node

from .controllers import JointPath
from .pipelines import Pipelines
from .plan_outcome import PlanOutcome
from .planning_scene_monitor import PlanningSceneMonitor
from .robot_description import RobotDescription
from .scene import SceneContents, state_fields, trajectory_fields

if TYPE_CHECKING:
    from trundle.ros import Message, Publisher

    from .trajectory_execution import TrajectoryExecution


class MoveGroupContext(Struct, frozen=True, eq=False, kw_only=True):
    """The node with its parts."""

    node: Node
    description: RobotDescription
    monitor: PlanningSceneMonitor
    pipelines: Pipelines
    execution: "TrajectoryExecution | None"
    """None: ~allow_trajectory_execution is false."""
    display: "Publisher"
    """moveit_msgs/DisplayTrajectory of each plan."""

    async def plan(self, request: "Message", contents: SceneContents, *, from_present: bool = False) -> PlanOutcome:
        """Answer a moveit_msgs/MotionPlanRequest in a scene, and show the plan; see `Pipelines.plan`."""
        outcome = await self.pipelines.plan(self.monitor, request, contents, from_present=from_present)
        if outcome.is_success and outcome.path is not None:
            self.show(outcome.path, outcome.start, contents)
        return outcome

    def show(self, path: JointPath, start: np.ndarray, contents: SceneContents) -> None:
        """Publish a plan for displays."""
        self.display.publish(
            {
                "model_id": self.monitor.model.name,
                "trajectory": [self.trajectory_fields(path)],
                "trajectory_start": self.state_fields(start, contents),
            }
        )

    def trajectory_fields(self, path: JointPath | None) -> dict[str, Any]:
        """Return the fields of a moveit_msgs/RobotTrajectory; None: an empty one."""
        if path is None:
            return {}
        return trajectory_fields(self.monitor.model, path)

    def state_fields(self, positions: np.ndarray, contents: SceneContents | None = None) -> dict[str, Any]:
        """Return the fields of a moveit_msgs/RobotState."""
        carried = None if contents is None else contents.carried
        stamp_ns = self.node.clock.now_ns()
        return state_fields(self.monitor.model, positions, stamp_ns=stamp_ns, carried=carried)

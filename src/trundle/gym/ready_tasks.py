"""Tasks of the built-in environments."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.assets import ASSETS
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from .actions import EffortAction, VelocityAction
from .observations import Computed, JointPositions, JointVelocities, LinkPosition
from .sensor_observations import LidarRanges
from .states import WorldStates
from .twist_action import TwistAction
from .worlds import TaskArguments

_FOLDER = ASSETS / "worlds"
_Array = NDArray[np.float64]

# -- cart and pole: keep the pole upright

_MAX_TILT, _MAX_DISTANCE = 0.3, 2.2
"""[rad], [m]"""


def _upright(states: WorldStates) -> _Array:
    return np.ones(states.rows)


def _fallen(states: WorldStates) -> NDArray[np.bool_]:
    position, tilt = states.joint_positions("slider", "hinge").T
    return (np.abs(position) > _MAX_DISTANCE) | (np.abs(tilt) > _MAX_TILT)


def _disturb(simulation: Simulation, random: np.random.Generator) -> None:
    cart_pole = simulation["cart_pole"]
    cart_pole.joint_positions = random.uniform(-0.05, 0.05, 2)
    cart_pole.joint_velocities = random.uniform(-0.05, 0.05, 2)


CART_POLE = TaskArguments(
    observations=[JointPositions("slider", "hinge"), JointVelocities("slider", "hinge")],
    actions=EffortAction("slider"),
    reward=_upright,
    terminated=_fallen,
    reset=_disturb,
    max_steps=500,
)

# -- arm: reach a goal

_REACHED_M = 0.05


def _hand_error(states: WorldStates) -> _Array:
    """Return the distances between hand and goal [m]."""
    return np.sqrt(np.square(states.link_positions("hand", relative_to="marker")).sum(axis=1))


def _closeness(states: WorldStates) -> _Array:
    error = _hand_error(states)
    return (error < _REACHED_M) - error


def _randomize_goal(simulation: Simulation, random: np.random.Generator) -> None:
    shoulder, elbow = random.uniform(-1.5, 1.5), random.uniform(0.4, 1.8)
    x = 0.5 * math.cos(shoulder) + 0.4 * math.cos(shoulder + elbow)
    y = 0.5 * math.sin(shoulder) + 0.4 * math.sin(shoulder + elbow)
    simulation["goal"].set_pose(Pose((x, y, 0.31)))
    simulation["arm"].joint_positions = [0.0, 0.5]


ARM_REACH = TaskArguments(
    observations=[
        LinkPosition("marker", relative_to="hand"),
        JointPositions("shoulder", "elbow"),
    ],
    actions=VelocityAction("shoulder", "elbow"),
    reward=_closeness,
    reset=_randomize_goal,
    max_steps=60,
    period_s=0.04,
)

# -- mobile robot: drive to a goal, around a pillar that only the lidar sees

GOAL_M = 0.25
_TOUCH_M = 0.33
"""Distance between the centers of robot and pillar that ends the episode [m]."""
_BONUS = 2.0
_PERIOD_S = 0.2


def _goal_in_robot(states: WorldStates) -> _Array:
    return states.link_positions("marker", relative_to="chassis")[:, :2]


def _has_arrived(states: WorldStates) -> NDArray[np.bool_]:
    return np.square(_goal_in_robot(states)).sum(axis=1) < GOAL_M**2


def _has_crashed(states: WorldStates) -> NDArray[np.bool_]:
    pillar = states.link_positions("pillar::pillar") - states.link_positions("chassis")
    return np.square(pillar[:, :2]).sum(axis=1) < _TOUCH_M**2


def _progress(states: WorldStates) -> _Array:
    """Return the distance towards the goal in this step [m], plus a bonus at the goal or minus it at the pillar."""
    offset = (states.link_positions("marker") - states.link_positions("chassis"))[:, :2]
    closing = (offset * states.link_twists("chassis")[:, :2]).sum(axis=1) / np.sqrt(np.square(offset).sum(axis=1))
    return closing * _PERIOD_S + _BONUS * _has_arrived(states) - _BONUS * _has_crashed(states)


def _randomize_goal_and_pillar(simulation: Simulation, random: np.random.Generator) -> None:
    bearing, distance = random.uniform(-math.pi, math.pi), random.uniform(1.8, 2.5)
    heading = bearing + random.uniform(-1.0, 1.0)
    along, across = distance * random.uniform(0.4, 0.6), random.uniform(-0.2, 0.2)
    cos, sin = math.cos(bearing), math.sin(bearing)
    simulation["goal"].set_pose(Pose((distance * cos, distance * sin, 0.02)))
    simulation["pillar"].set_pose(Pose((along * cos - across * sin, along * sin + across * cos, 0.26)))
    simulation["robot"].set_pose(Pose.from_rpy(0.0, 0.0, 0.08, 0.0, 0.0, heading))


DRIVE_TO_GOAL = TaskArguments(
    observations=[Computed(_goal_in_robot, low=[-4.0, -4.0], high=[4.0, 4.0]), LidarRanges("scan")],
    actions=TwistAction("robot", max_forward=0.6, max_yaw_rate=2.0, backward=False),
    reward=_progress,
    terminated=lambda states: _has_arrived(states) | _has_crashed(states),
    reset=_randomize_goal_and_pillar,
    max_steps=40,
    period_s=_PERIOD_S,
)

READY = {
    "Trundle/ArmReach-v0": (_FOLDER / "arm_reach.world", ARM_REACH),
    "Trundle/CartPole-v0": (_FOLDER / "cart_pole.world", CART_POLE),
    "Trundle/DriveToGoal-v0": (_FOLDER / "drive_to_goal.world", DRIVE_TO_GOAL),
}
"""Gymnasium's id → description and task."""

"""Recovery behaviors, which move_base runs when it finds no plan or no velocity."""

import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from trundle.gazebo.nodes.rate import Rate
from trundle.navigation import _grids
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node
from trundle.spatial import NS_PER_S

from ..costmap import CostmapRos
from ..planners import LocalPlanner

_CLEARABLE = ["obstacle_layer", "obstacles"]
_STALL_S, _STALL_RAD = 3.0, 0.05
"""A rotation is given up when the robot turns less than this in that time."""
Drive = Callable[[float, float, float], None]


class RecoveryBehavior(Protocol):
    """nav_core::RecoveryBehavior."""

    name: str

    async def run(self) -> None:
        """Recover; cancelled with the goal."""
        ...


class Surroundings(NamedTuple):
    """Costmaps, velocity commands and parameters that recovery behaviors use."""

    node: Node
    global_costmap: CostmapRos
    local_costmap: CostmapRos
    drive: Drive
    """Commands a velocity x, y [m/s], yaw [rad/s]."""
    root: RosParameters
    local_planner: LocalPlanner
    local_space: str
    """Name of the local planner's namespace."""


class ClearCostmapRecovery:
    """Forgets the obstacles outside a square around the robot.

    Parameters, with the original's defaults: reset_distance 3, invert_area_to_clear false, force_updating false,
    affected_maps both (or local, global), layer_names [obstacle_layer].
    """

    def __init__(self, name: str, settings: RosParameters, surroundings: Surroundings) -> None:
        self.name = name
        self._surroundings = surroundings
        self._size_m = settings.number("reset_distance", 3.0)
        self._inverts = settings.flag("invert_area_to_clear", default=False)
        self._maps = settings.text("affected_maps", "both")
        self._layers = settings.texts("layer_names") or _CLEARABLE

    async def run(self) -> None:
        """See `RecoveryBehavior`."""
        node = self._surroundings.node
        costmaps = {"global": self._surroundings.global_costmap, "local": self._surroundings.local_costmap}
        for which, costmap in costmaps.items():
            if self._maps not in (which, "both"):
                continue
            where = "inside" if self._inverts else "outside"
            node.log.warn(
                f"Clearing {which} costmap {where} a square ({self._size_m:.2f}m) large centered on the robot."
            )
            costmap.clear_outside(self._size_m, self._layers, invert=self._inverts)


class RotateRecovery:
    """Turns the robot once around; gives up if it does not turn, as a car.

    Parameters, with the original's defaults: sim_granularity 0.017, frequency 20; acc_lim_th 3.2, max_vel_theta 1,
    min_in_place_vel_theta 0.4 and yaw_goal_tolerance 0.1 of the local planner.
    """

    def __init__(self, name: str, settings: RosParameters, surroundings: Surroundings) -> None:
        self.name = name
        self._surroundings = surroundings
        planner = surroundings.root.section(surroundings.local_space)
        spaces = (settings, planner)

        def number(field: str, default: float, *, above: float = 0.0) -> float:
            space = next((space for space in spaces if field in space), settings)
            return space.number(field, default, above=above)

        self._granularity = settings.number("sim_granularity", 0.017, above=0.0)
        self._frequency_hz = settings.number("frequency", 20.0, above=0.0)
        self._acceleration = number("acc_lim_th", number("acc_lim_theta", 3.2))
        self._most = number("max_vel_theta", number("max_rotational_vel", 1.0))
        self._least = number("min_in_place_vel_theta", number("min_in_place_rotational_vel", 0.4))
        self._tolerance = number("yaw_goal_tolerance", 0.1)

    async def run(self) -> None:
        """See `RecoveryBehavior`."""
        node, costmap = self._surroundings.node, self._surroundings.local_costmap
        node.log.warn("Rotate recovery behavior started.")
        rate = Rate(node, self._frequency_hz)
        begun = last = costmap.robot_pose()
        turned = counted = 0.0
        counted_ns = node.clock.now_ns()
        while begun is not None and not node.closed.is_set():
            pose = costmap.robot_pose()
            if pose is None or last is None:
                break
            turned += math.remainder(pose[2] - last[2], 2.0 * math.pi)
            last = pose
            left = 2.0 * math.pi - turned
            if left <= self._tolerance:
                break
            now_ns = node.clock.now_ns()
            if turned >= counted + _STALL_RAD:
                counted, counted_ns = turned, now_ns
            elif now_ns - counted_ns > _STALL_S * NS_PER_S:
                node.log.warn(f"Rotate recovery is given up: the robot has not turned for {_STALL_S:g} s.")
                break
            if not self._is_free(pose, left):
                node.log.error(
                    f"Rotate recovery can't rotate in place because there is a potential collision. Cost: {-1.0:.2f}"
                )
                break
            speed = math.sqrt(2.0 * self._acceleration * left)
            self._surroundings.drive(0.0, 0.0, min(max(speed, self._least), self._most))
            await rate.sleep()
        self._surroundings.drive(0.0, 0.0, 0.0)

    def _is_free(self, pose: tuple[float, float, float], left: float) -> bool:
        """True if the footprint touches nothing in the rest of the turn."""
        costmap = self._surroundings.local_costmap
        grid = costmap.costmap
        count = max(int(min(left, 2.0 * math.pi) / self._granularity), 1)
        return all(
            _grids.footprint_cost(
                grid.cells, grid.origin, grid.resolution_m, costmap.footprint, (pose[0], pose[1], float(yaw))
            )
            >= 0.0
            for yaw in np.linspace(pose[2], pose[2] + left, count)
        )


class MoveSlowAndClear:
    """Forgets the obstacles in a square around the robot, and limits its speed until it has moved on.

    Parameters, with the original's defaults: clearing_distance 0.5, limited_distance 0.3, limited_trans_speed 0.25,
    limited_rot_speed 0.45. It changes the local planner's limits; max_trans_param_name and max_rot_param_name are not
    read.
    """

    def __init__(self, name: str, settings: RosParameters, surroundings: Surroundings) -> None:
        self.name = name
        self._surroundings = surroundings
        self._clear_m = settings.number("clearing_distance", 0.5)
        self._distance_m = settings.number("limited_distance", 0.3)
        self._limits = settings.number("limited_trans_speed", 0.25), settings.number("limited_rot_speed", 0.45)
        self._begun: tuple[float, float, float] | None = None
        """Position where the limit began; None: the speed is not limited."""

    async def run(self) -> None:
        """See `RecoveryBehavior`."""
        node, planner = self._surroundings.node, self._surroundings.local_planner
        node.log.warn("Move slow and clear recovery behavior started.")
        for costmap in (self._surroundings.global_costmap, self._surroundings.local_costmap):
            costmap.clear_outside(2.0 * self._clear_m, _CLEARABLE, invert=True)
        is_limited, self._begun = self._begun is not None, self._surroundings.global_costmap.robot_pose()
        if self._begun is not None and not is_limited:
            usual = planner.speed_limits
            planner.speed_limits = min(usual[0], self._limits[0]), min(usual[1], self._limits[1])
            node.loop.spawn(self._lift(usual))

    async def _lift(self, usual: tuple[float, float]) -> None:
        """Restore the usual limits once the robot has moved far enough."""
        node = self._surroundings.node
        while self._begun is not None and not node.closed.is_set():
            await node.clock.sleep(0.1)
            pose = self._surroundings.global_costmap.robot_pose()
            if pose is not None and math.dist(pose[:2], self._begun[:2]) >= self._distance_m:
                node.log.info("Moved far enough, removing speed limit.")
                self._surroundings.local_planner.speed_limits = usual
                self._begun = None


_TYPES: dict[str, Callable[[str, RosParameters, Surroundings], RecoveryBehavior]] = {
    "clear_costmap_recovery/ClearCostmapRecovery": ClearCostmapRecovery,
    "rotate_recovery/RotateRecovery": RotateRecovery,
    "move_slow_and_clear/MoveSlowAndClear": MoveSlowAndClear,
}


def read_behaviors(settings: RosParameters, surroundings: Surroundings) -> list[RecoveryBehavior]:
    """Make the behaviors of `recovery_behaviors`; without it, those of move_base: clear, rotate, clear more, rotate."""
    node = surroundings.node
    if "recovery_behaviors" not in settings:
        return _default_behaviors(settings, surroundings)
    behaviors: list[RecoveryBehavior] = []
    try:
        listed = [(section.text("name"), section.text("type")) for section in settings.sections("recovery_behaviors")]
        names = [name for name, _ in listed]
        if len(set(names)) < len(names):
            raise ParamError(f"two behaviors have one name: {', '.join(names)}")
        for name, kind in listed:
            make = _TYPES.get(kind) or next((made for key, made in _TYPES.items() if key.endswith(f"/{kind}")), None)
            if make is None:
                raise ParamError(f"no recovery behavior {kind!r}; there are: {', '.join(_TYPES)}")
            behaviors.append(make(name, settings.section(name), surroundings))
    except ParamError as error:
        node.log.error(f"{settings.namespace}/recovery_behaviors: {error}; move_base's own are used")
        return _default_behaviors(settings, surroundings)
    return behaviors


def _default_behaviors(settings: RosParameters, surroundings: Surroundings) -> list[RecoveryBehavior]:
    conservative_m = settings.number("conservative_reset_dist", 3.0)
    radius_m = settings.section("local_costmap").number("circumscribed_radius", 0.46)
    sizes = {"conservative_reset": conservative_m, "aggressive_reset": 4.0 * radius_m}

    def clear(name: str) -> RecoveryBehavior:
        section = settings.section(name)
        tree = {key: section.items(key) if key == "layer_names" else section.text(key) for key in section.names()}
        own = RosParameters({"reset_distance": sizes[name], **tree}, section.namespace)
        return ClearCostmapRecovery(name, own, surroundings)

    is_turning = settings.flag("clearing_rotation_allowed", default=True)
    rotate = (
        [RotateRecovery("rotate_recovery", settings.section("rotate_recovery"), surroundings)] if is_turning else []
    )
    return [clear("conservative_reset"), *rotate, clear("aggressive_reset"), *rotate]

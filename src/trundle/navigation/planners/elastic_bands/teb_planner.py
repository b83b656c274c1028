"""teb_local_planner/TebLocalPlannerROS: velocities along a timed elastic band (Rösmann et al. 2012, 2017)."""

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.robots.parameters import RosParameters
from trundle.ros import Node, Publisher, TransformBuffer
from trundle.spatial import NS_PER_S

from ...costmap import CostmapRos
from ...settings import read_settings, reconfigure
from ..followed_plan import FollowedPlan, lengths_along
from ..interfaces import Plan, Pose2D
from ..motion import OdometryReader, angle_between
from ..path_message import path_message
from ._bands import obstacle_outline
from .band_topics import BandTopics
from .candidates import Candidate, Candidates, Velocity, headings
from .teb_settings import USED, WITHOUT_EFFECT, TebSettings, band_settings, read_body
from .unused_parameters import report_unused

_VISIBLE = 0.85
"""Share of the local costmap's half in which the plan is followed, as in the original."""
_CHECKED_M = 0.05
_CHECKED_RAD = 0.1


class TebLocalPlannerROS:
    """Deforms the plan in time and space toward the fastest way within the robot's limits, away from obstacles.

    Parameters are the original's (`TebSettings`), and `footprint_model`. Topics: `~NAME/global_plan`, `local_plan`,
    `teb_poses`, `teb_markers`, `teb_feedback`; `~NAME/obstacles` and `via_points` are received. A car-like robot
    (`min_turning_radius`) is never commanded a tighter turn, also where the band has one.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        section: RosParameters,
        root: RosParameters,
        costmap: CostmapRos,
        buffer: TransformBuffer,
        odom: OdometryReader,
    ) -> None:
        del root
        self._node = node
        self._costmap = costmap
        self._odom = odom
        self._settings = settings = read_settings(TebSettings, section)
        self._body = read_body(section, costmap.footprint)
        report_unused(node, section, "teb_local_planner", used=USED, without_effect=WITHOUT_EFFECT)
        self._plan = FollowedPlan(node, costmap, buffer)
        self._candidates = Candidates(settings)
        self._topics = BandTopics(node, name, costmap, buffer)
        self._shrunk_ns: int | None = None
        """Time at which a band was infeasible; the plan is followed half as far for a while."""
        self._global = node.advertise(f"~{name}/global_plan", "nav_msgs/Path", queue_size=1)
        self._local = node.advertise(f"~{name}/local_plan", "nav_msgs/Path", queue_size=1)
        reconfigure(node, f"{node.name}/{name}", settings, lambda: None)

    @property
    def speed_limits(self) -> tuple[float, float]:
        """See `LocalPlanner`."""
        return self._settings.max_vel_x, self._settings.max_vel_theta

    @speed_limits.setter
    def speed_limits(self, limits: tuple[float, float]) -> None:
        self._settings.max_vel_x, self._settings.max_vel_theta = limits

    def start(self) -> None:
        """See `LocalPlanner`."""
        self._candidates.clear()
        self._shrunk_ns = None

    def set_plan(self, plan: Plan) -> None:
        """See `LocalPlanner`."""
        self._plan.set(plan)

    def is_goal_reached(self) -> bool:
        """See `LocalPlanner`."""
        found, goal, settings = self._costmap.robot_pose(), self._plan.goal(), self._settings
        if found is None or goal is None:
            return False
        pose = Pose2D(*found)
        if math.hypot(goal.x - pose.x, goal.y - pose.y) > settings.xy_goal_tolerance:
            return False
        x, y, turn = self._odom.velocity
        stands = math.hypot(x, y) <= settings.trans_stopped_vel and abs(turn) <= settings.theta_stopped_vel
        if abs(angle_between(pose.yaw, goal.yaw)) > settings.yaw_goal_tolerance:
            return False
        if not (stands or settings.free_goal_vel):
            return False
        self._node.log.info("GOAL Reached!")
        return True

    def velocity(self) -> Velocity | None:
        """See `LocalPlanner`."""
        found = self._costmap.robot_pose()
        if found is None:
            self._node.log.error("Could not get robot pose")
            return None
        pose = Pose2D(*found)
        plan = self._visible_plan(pose)
        if plan is None:
            self._node.log.error("Could not get local plan")
            return None
        self._publish(self._global, plan)
        settings = self._settings
        best = self._candidates.optimize(
            self._costmap.costmap,
            plan,
            band_settings(settings),
            self._body,
            obstacles=self._obstacles(pose, plan),
            via_points=self._via_points(plan),
            velocity=self._odom.velocity,
            time_s=self._node.clock.now_ns() / NS_PER_S,
        )
        if best is None or not self._is_feasible(best):
            self._node.log.warn("TebLocalPlannerROS: trajectory is not feasible. Resetting planner...")
            self._candidates.clear()
            self._shrunk_ns = self._node.clock.now_ns()
            return None
        self._publish(self._local, best.band.poses)
        velocities = self._velocities(best) if settings.publish_feedback else np.empty((0, 3))
        self._topics.publish(best, self._candidates.bands, velocities)
        return self._command(best)

    def _visible_plan(self, pose: Pose2D) -> NDArray[np.float64] | None:
        """Return the plan (n, 3) from the robot's pose on, as far as the costmap and the parameters let see."""
        found, goal = self._plan.local(pose), self._plan.goal()
        if found is None or goal is None:
            return None
        settings, grid = self._settings, self._costmap.costmap
        reach = _VISIBLE * 0.5 * min(grid.width, grid.height) * grid.resolution_m
        limit_m = settings.max_global_plan_lookahead_dist or math.inf
        if self._shrunk_ns is not None and settings.shrink_horizon_backup:
            past_s = (self._node.clock.now_ns() - self._shrunk_ns) / NS_PER_S
            if past_s < settings.shrink_horizon_min_duration:
                limit_m = 0.5 * min(limit_m, reach)
        is_far = np.hypot(found[:, 0] - pose.x, found[:, 1] - pose.y) > reach
        is_far |= lengths_along(found) > limit_m
        count = int(np.argmax(is_far)) if is_far.any() else len(found)
        ahead = found[1 : max(count, 2)] if len(found) > 1 else np.array([goal])
        plan: NDArray[np.float64] = np.vstack([np.array([pose]), ahead])
        is_whole = math.hypot(plan[-1, 0] - goal.x, plan[-1, 1] - goal.y) < 1e-6
        if settings.global_plan_overwrite_orientation:
            plan[1:, 2] = headings(plan)[1:]
        if is_whole:
            plan[-1] = goal
        way = math.cos(pose.yaw) * (plan[-1, 0] - pose.x) + math.sin(pose.yaw) * (plan[-1, 1] - pose.y)
        if settings.allow_init_with_backwards_motion and is_whole and way < 0.0:
            plan[1:-1, 2] = np.remainder(plan[1:-1, 2] + 2.0 * math.pi, 2.0 * math.pi) - math.pi
        return plan

    def _obstacles(self, pose: Pose2D, plan: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points (n, 2) of the costmap's obstacles and of those received [m]."""
        settings, grid = self._settings, self._costmap.costmap
        received = self._topics.obstacles
        if not settings.include_costmap_obstacles:
            return received
        points = np.array(grid.origin) + (obstacle_outline(grid.cells) + 0.5) * grid.resolution_m
        rays = points - np.array([pose.x, pose.y])
        is_behind = rays @ np.array([math.cos(pose.yaw), math.sin(pose.yaw)]) < 0.0
        is_far = np.hypot(rays[:, 0], rays[:, 1]) > settings.costmap_obstacles_behind_robot_dist
        goes_back = (plan[-1, :2] - plan[0, :2]) @ np.array([math.cos(pose.yaw), math.sin(pose.yaw)]) < 0.0
        kept = points if goes_back else points[~(is_behind & is_far)]
        return np.ascontiguousarray(np.vstack([kept, received]))

    def _via_points(self, plan: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points (n, 2) received, else those of the plan at `global_plan_viapoint_sep` [m]."""
        received, separation = self._topics.via_points, self._settings.global_plan_viapoint_sep
        if received is not None:
            return received
        if separation <= 0.0:
            return np.empty((0, 2))
        along = lengths_along(plan)
        places = np.searchsorted(along, np.arange(separation, along[-1], separation))
        return np.ascontiguousarray(plan[np.unique(places[places < len(plan) - 1]), :2])

    def _is_feasible(self, best: Candidate) -> bool:
        """True if the costmap's footprint touches nothing along the first poses, and between them."""
        count, poses, grid = self._settings.feasibility_check_no_poses, best.band.poses, self._costmap.costmap
        last = len(poses) - 1 if count < 0 else min(count, len(poses) - 1)
        for a, b in itertools.pairwise(poses[: last + 1]):
            turn = angle_between(float(a[2]), float(b[2]))
            parts = max(math.ceil(math.hypot(*(b - a)[:2]) / _CHECKED_M), math.ceil(abs(turn) / _CHECKED_RAD), 1)
            change = np.array([b[0] - a[0], b[1] - a[1], turn])
            for share in np.arange(1, parts + 1) / parts:
                x, y, yaw = (a + share * change).tolist()
                cost = _grids.footprint_cost(
                    grid.cells, grid.origin, grid.resolution_m, self._costmap.footprint, (x, y, yaw)
                )
                if cost < 0.0:
                    return False
        return True

    def _velocities(self, best: Candidate) -> NDArray[np.float64]:
        """Return the velocity (n, 3) of each step of a band: ahead, sideways [m/s], turning [rad/s]."""
        poses, steps = best.band.poses, best.band.steps
        pairs = zip(poses[:-1], poses[1:], steps.tolist(), strict=True)
        return np.array([self._motion(a, b, time_s) for a, b, time_s in pairs])

    def _motion(self, a: NDArray[np.float64], b: NDArray[np.float64], time_s: float) -> Velocity:
        dx, dy, yaw = float(b[0] - a[0]), float(b[1] - a[1]), float(a[2])
        turn = angle_between(yaw, float(b[2])) / time_s
        ahead = math.cos(yaw) * dx + math.sin(yaw) * dy
        if self._settings.max_vel_y > 0.0:
            return ahead / time_s, (math.cos(yaw) * dy - math.sin(yaw) * dx) / time_s, turn
        return math.copysign(math.hypot(dx, dy), ahead) / time_s, 0.0, turn

    def _command(self, best: Candidate) -> Velocity:
        """Return the velocity to command, within the limits; a steering angle if parameters ask for it."""
        settings, poses, steps = self._settings, best.band.poses, best.band.steps
        ahead = min(settings.control_look_ahead_poses, len(steps))
        velocity = self._motion(poses[0], poses[ahead], max(float(steps[:ahead].sum()), 1e-3))
        x, y, turn = self._saturated(velocity)
        if settings.min_turning_radius > 0.0:
            most = abs(x) / settings.min_turning_radius
            turn = min(max(turn, -most), most)
        if settings.cmd_angle_instead_rotvel:
            turn = 0.0 if x == 0.0 or turn == 0.0 else math.atan(settings.wheelbase * turn / x)
        return x, y, turn

    def _saturated(self, velocity: Velocity) -> Velocity:
        settings = self._settings
        x, y, turn = velocity
        limits = (settings.max_vel_x if x > 0.0 else settings.max_vel_x_backwards, settings.max_vel_y)
        shares = [
            min(1.0, limit / abs(value)) if abs(value) > 1e-9 else 1.0
            for value, limit in zip(velocity, (*limits, settings.max_vel_theta), strict=True)
        ]
        if settings.use_proportional_saturation or settings.min_turning_radius > 0.0:
            shares = [min(shares)] * 3
        x, y, turn = (value * share for value, share in zip((x, y, turn), shares, strict=True))
        speed, most = math.hypot(x, y), max(settings.max_vel_trans, settings.max_vel_x)
        if settings.max_vel_y > 0.0 and speed > most:
            x, y = x * most / speed, y * most / speed
        return x, y, turn

    def _publish(self, publisher: Publisher, poses: NDArray[np.float64]) -> None:
        if publisher.has_subscribers:
            publisher.publish(path_message(Plan(self._costmap.frame, poses), self._node.clock.now_ns()))

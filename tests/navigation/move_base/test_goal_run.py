"""States of a run to a goal, with a robot and planners of a few lines."""

import asyncio
import logging
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from trundle.navigation.move_base.goal_run import GoalRun
from trundle.navigation.move_base.node import MoveBaseSettings
from trundle.navigation.move_base.recovery import MoveSlowAndClear, RotateRecovery, Surroundings
from trundle.navigation.planners import Plan, Pose2D
from trundle.robots.parameters import RosParameters
from trundle.ros import PendingWork

_PERIOD_NS = 50_000_000


class Robot:
    """Clock, node, costmaps and planners of a robot that drives where it is told."""

    frame = "map"
    is_current = True
    footprint = np.empty((0, 2))

    def __init__(self, velocity: tuple[float, float, float] | None = (0.1, 0.0, 0.0)) -> None:
        self.time_ns = 0
        self.x, self.yaw = 0.0, 0.0
        self.commands: list[tuple[float, float, float]] = []
        self.chosen = velocity
        self.speed_limits = (0.5, 1.0)
        self.cleared_m: list[float] = []
        self.has_plan = True
        self.cells = np.zeros((40, 40), np.uint8)
        self.costmap = SimpleNamespace(cells=self.cells, origin=(-2.0, -2.0), resolution_m=0.1)
        log = logging.getLogger("robot")
        log_methods = SimpleNamespace(warn=log.warning, error=log.error, info=log.info)
        self.node: Any = SimpleNamespace(
            name="/move_base",
            log=log_methods,
            clock=self,
            closed=asyncio.Event(),
            loop=SimpleNamespace(work=PendingWork(), spawn=asyncio.ensure_future),
        )

    def now_ns(self) -> int:
        return self.time_ns

    async def sleep(self, seconds: float) -> None:
        del seconds
        await asyncio.sleep(0)

    async def sleep_until(self, ns: int) -> None:
        speed, _, turn = self.commands[-1] if self.commands else (0.0, 0.0, 0.0)
        self.x += speed * (ns - self.time_ns) / 1e9
        self.yaw += turn * (ns - self.time_ns) / 1e9
        self.time_ns = max(self.time_ns, ns)
        await asyncio.sleep(0)  # planning goes on

    def robot_pose(self) -> tuple[float, float, float]:
        return self.x, 0.0, math.remainder(self.yaw, 2.0 * math.pi)

    def clear_outside(self, size_m: float, layers: list[str], *, invert: bool) -> None:
        assert invert
        assert "obstacle_layer" in layers
        self.cleared_m.append(size_m)

    def drive(self, *velocity: float) -> None:
        x, y, turn = velocity
        self.commands.append((x, y, turn))

    def start(self) -> None: ...

    def set_plan(self, plan: Plan) -> None: ...

    async def make_plan(self, start: Pose2D, goal: Pose2D, tolerance: float | None = None) -> Plan | None:
        del tolerance
        return Plan("map", np.array([start, goal])) if self.has_plan else None

    def publish(self, plan: Plan) -> None: ...

    def velocity(self) -> tuple[float, float, float] | None:
        return self.chosen

    def is_goal_reached(self) -> bool:
        return self.x >= 1.0

    def run(self, behaviors: Any = (), **settings: Any) -> Any:
        robot: Any = self
        run = GoalRun(
            self.node,
            MoveBaseSettings(**settings),
            Pose2D(1.0, 0.0, 0.0),
            global_costmap=robot,
            local_costmap=robot,
            global_planner=robot,
            local_planner=robot,
            behaviors=behaviors,
            drive=self.drive,
            report=lambda *_: None,
        )
        return asyncio.run(run.drive(lambda _: None))


def test_a_run_ends_with_the_robot_at_rest_at_its_goal() -> None:
    robot = Robot()

    result = robot.run()

    assert (result.status, result.text) == ("succeeded", "Goal reached.")
    assert robot.commands[-1] == (0.0, 0.0, 0.0)
    assert robot.time_ns == pytest.approx(10.0e9, abs=2 * _PERIOD_NS)


@pytest.mark.parametrize(
    ("velocity", "settings", "seconds", "text"),
    [
        (None, {"controller_patience": 3.0}, 3.0, "Failed to find a valid control. "),
        ((0.0, 0.0, 0.5), {"oscillation_timeout": 4.0}, 4.0, "Robot is oscillating. "),
    ],
    ids=["no velocity", "no progress"],
)
def test_a_run_is_given_up_when_its_patience_is_over(
    velocity: tuple[float, float, float] | None, settings: dict[str, float], seconds: float, text: str
) -> None:
    robot = Robot(velocity)

    result = robot.run(**settings)

    assert (result.status, result.text) == ("aborted", f"{text}Even after executing recovery behaviors.")
    assert robot.time_ns == pytest.approx(seconds * 1e9, abs=3 * _PERIOD_NS)


def test_without_a_plan_a_run_is_given_up_after_the_planners_patience() -> None:
    robot = Robot()
    robot.has_plan = False

    result = robot.run(planner_patience=2.0)

    assert result.text == "Failed to find a valid plan. Even after executing recovery behaviors."
    assert robot.time_ns == pytest.approx(2.0e9, abs=3 * _PERIOD_NS)


def test_after_a_recovery_that_helped_the_goal_is_reached() -> None:
    robot = Robot(None)

    class Help:
        name = "help"

        async def run(self) -> None:
            robot.chosen = (0.1, 0.0, 0.0)

    assert robot.run([Help()], controller_patience=1.0).status == "succeeded"


def _rotate(robot: Robot) -> None:
    costmaps: Any = robot
    empty = RosParameters({}, "/move_base")
    surroundings = Surroundings(robot.node, costmaps, costmaps, robot.drive, empty, costmaps, "DWAPlannerROS")
    asyncio.run(RotateRecovery("rotate_recovery", empty, surroundings).run())


def test_a_rotation_turns_once_around_and_stops() -> None:
    robot = Robot()

    _rotate(robot)

    assert robot.yaw == pytest.approx(2.0 * math.pi, abs=0.15)
    assert robot.commands[-1] == (0.0, 0.0, 0.0)


def test_a_rotation_beside_an_obstacle_is_refused() -> None:
    robot = Robot()
    robot.cells[20, 23] = 254
    robot.footprint = np.array([[0.3, 0.1], [0.3, -0.1], [-0.3, -0.1], [-0.3, 0.1]])

    _rotate(robot)

    assert robot.yaw == 0.0
    assert robot.commands == [(0.0, 0.0, 0.0)]


def test_a_rotation_of_a_robot_that_does_not_turn_on_the_spot_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    car = Robot()
    drive = car.drive
    monkeypatch.setattr(car, "drive", lambda x, y, turn: drive(x, y, turn if x else 0.0))

    _rotate(car)

    assert car.yaw == 0.0
    assert 3.0 < car.time_ns / 1e9 < 4.0


def test_the_robot_moves_slowly_until_it_is_past_what_was_cleared() -> None:
    robot = Robot()
    costmaps: Any = robot
    settings = RosParameters({"limited_trans_speed": 0.2, "clearing_distance": 0.4}, "/move_base/slow")
    surroundings = Surroundings(robot.node, costmaps, costmaps, robot.drive, settings, costmaps, "DWAPlannerROS")
    behavior = MoveSlowAndClear("slow", settings, surroundings)

    async def recover_twice() -> list[float]:
        """Recover at 0 m and 0.2 m; return the limit at each tenth of a metre."""
        limits: list[float] = []
        robot.drive(0.1, 0.0, 0.0)
        for decimetre in range(7):
            if decimetre in (0, 2):
                await behavior.run()
            limits.append(robot.speed_limits[0])
            robot.time_ns += 10**9
            robot.x += 0.1
            for _ in range(4):  # the behavior looks where the robot is
                await asyncio.sleep(0)
        return limits

    assert asyncio.run(recover_twice()) == [0.2, 0.2, 0.2, 0.2, 0.2, 0.5, 0.5]
    assert robot.cleared_m == [0.8] * 4

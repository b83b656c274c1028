"""Plans that are executed at once: watched while they run, and planned anew where the world changed."""

import asyncio
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING

from msgspec.structs import replace

from trundle.planning.planners import ErrorCode

from .controllers import JointPath, Outcome
from .plan_outcome import PlanOutcome

if TYPE_CHECKING:
    from trundle.planning.planning_scene import AllowedCollisionMatrix

    from .move_group_context import MoveGroupContext

_LOOK_S = 0.1
_CODES = {
    Outcome.SUCCEEDED: ErrorCode.SUCCESS,
    Outcome.PREEMPTED: ErrorCode.PREEMPTED,
    Outcome.TIMED_OUT: ErrorCode.TIMED_OUT,
    Outcome.ABORTED: ErrorCode.CONTROL_FAILED,
    Outcome.FAILED: ErrorCode.CONTROL_FAILED,
}


async def plan_and_execute(
    context: "MoveGroupContext",
    plan: Callable[[], Awaitable[PlanOutcome]],
    *,
    attempts: int = 1,
    delay_s: float = 0.0,
    before_execution: Callable[[], None] = lambda: None,
) -> PlanOutcome:
    """Plan and execute; a path that a change of the world blocks is planned anew.

    Args:
        context: node.
        plan: makes a plan from the present state.
        attempts: greatest number of plans.
        delay_s: pause before a new plan [s].
        before_execution: called when a plan is found.
    """
    node = context.node
    for attempt in range(1, attempts + 1):
        node.log.info(f"Planning attempt {attempt} of at most {attempts}")
        outcome = await plan()
        if outcome.code in (ErrorCode.PLANNING_FAILED, ErrorCode.INVALID_MOTION_PLAN) and attempt < attempts:
            continue
        if not outcome.is_success or outcome.path is None:
            return outcome
        before_execution()
        code = await execute_watched(context, outcome)
        outcome = replace(outcome, code=code)
        if code is not ErrorCode.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE or attempt == attempts:
            return outcome
        if delay_s > 0.0:
            node.log.info(f"Waiting for a {delay_s:f} seconds before attempting a new plan ...")
            await node.clock.sleep(delay_s)
            node.log.info("Done waiting")
    return outcome  # pyright: ignore[reportPossiblyUnboundVariable]: there is at least one attempt


async def execute_watched(
    context: "MoveGroupContext", outcome: PlanOutcome, *, allowed: "AllowedCollisionMatrix | None" = None
) -> ErrorCode:
    """Execute a path, and stop where the world has changed so that the rest of it collides.

    Args:
        context: node.
        outcome: a plan with a path.
        allowed: what may touch on the way; None: as in the scene.
    """
    path, execution = outcome.path, context.execution
    if execution is None or path is None:
        context.node.log.error("No trajectory execution manager")
        return ErrorCode.CONTROL_FAILED
    run = asyncio.create_task(execution.execute(path))
    changes = context.monitor.changes
    clock = context.node.clock
    start_ns = clock.now_ns()
    try:
        while not run.done():
            await asyncio.wait({run, asyncio.ensure_future(clock.sleep(_LOOK_S))}, return_when=asyncio.FIRST_COMPLETED)
            if run.done() or context.monitor.changes == changes:
                continue
            changes = context.monitor.changes
            rest = _rest(path, (clock.now_ns() - start_ns) / 1e9)
            if not await context.pipelines.is_path_valid(context.monitor, rest, outcome.start, outcome.group, allowed):
                context.node.log.info(
                    "Stopping execution because the path to execute became invalid(probably the environment changed)"
                )
                execution.stop()
                await asyncio.gather(run, return_exceptions=True)
                return ErrorCode.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE
    except asyncio.CancelledError:
        context.node.log.info("Stopping execution due to preempt request")
        run.cancel()
        await asyncio.gather(run, return_exceptions=True)
        raise
    return _CODES[run.result()]


def _rest(path: JointPath, elapsed_s: float) -> JointPath:
    """Return what remains of a path after a time."""
    kept = path.times_s >= elapsed_s
    if not kept.any():
        kept[-1] = True
    return JointPath(joints=path.joints, times_s=path.times_s[kept], positions=path.positions[kept])

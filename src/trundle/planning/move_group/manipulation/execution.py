"""Execution of stages, with what they change in the scene."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from trundle.planning.planners import ErrorCode

from ..plan_execution import execute_watched
from ..plan_outcome import PlanOutcome
from ..scene import SceneContents
from .manipulation_plan import ManipulationGoal, Stage

if TYPE_CHECKING:
    from ..move_group_context import MoveGroupContext


async def execute_stages(
    context: "MoveGroupContext", manipulation: ManipulationGoal, stages: Sequence[Stage], report: Callable[[str], None]
) -> ErrorCode:
    """Execute stages one after another; returns how it ended."""
    monitor = context.monitor
    for stage in stages:
        report(stage.description)
        context.node.log.info(f"Executing '{stage.description}'")
        outcome = PlanOutcome(code=ErrorCode.SUCCESS, start=stage.start, group=stage.group, path=stage.path)
        code = await execute_watched(context, outcome, allowed=manipulation.before.allowed)
        if code is not ErrorCode.SUCCESS:
            return code
        if stage.changes_scene:
            monitor.replace(_merged(monitor.contents, manipulation))
    return ErrorCode.SUCCESS


def _merged(contents: SceneContents, manipulation: ManipulationGoal) -> SceneContents:
    """Return the present scene with the object attached or placed as the manipulation says."""
    changed = contents.copy()
    before, after = manipulation.before, manipulation.after
    for name in [*before.objects, *before.carried]:
        if name in after.carried and name not in before.carried:
            changed.objects.pop(name, None)
            changed.carried[name] = after.carried[name]
        elif name in after.objects and name not in before.objects:
            changed.carried.pop(name, None)
            changed.objects[name] = after.objects[name]
    return changed

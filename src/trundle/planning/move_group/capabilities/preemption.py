"""Results of cancelled goals: the original's have an error code, too."""

import asyncio
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from trundle.planning.planners import ErrorCode
from trundle.ros import ActionResult

from ..error_codes import result_text

if TYPE_CHECKING:
    from trundle.ros import Message

_Work: TypeAlias = "Callable[[Message, Callable[[], None]], Awaitable[ActionResult]]"


def preemptible(work: _Work, *, field: str = "") -> _Work:
    """Return an action's work whose result has the code PREEMPTED if its goal is cancelled.

    Args:
        work: work of an `ActionServer`.
        field: field of the result that has the error code; empty: the result itself.
    """
    code: dict[str, Any] = {"error_code": {"val": int(ErrorCode.PREEMPTED)}}
    text = result_text(ErrorCode.PREEMPTED, is_empty=True, plan_only=False)

    async def run(goal: "Message", accept: Callable[[], None]) -> ActionResult:
        try:
            return await work(goal, accept)
        except asyncio.CancelledError:
            return ActionResult(status="preempted", result={field: code} if field else code, text=text)

    return run

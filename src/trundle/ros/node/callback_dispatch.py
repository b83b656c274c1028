"""Runs functions on a node's callback thread and awaits them on the loop."""

import asyncio
from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

from .loop import GraphLoop

_Result = TypeVar("_Result")
Callback: TypeAlias = Callable[[], Callable[[], object] | None]
"""Runs the callback of a message or request; returns a function that repeats the call if it came from outside."""
Deliver: TypeAlias = Callable[[Callback], None]
"""Schedules a callback outside the loop."""


async def run_on_callback_thread(deliver: Deliver | None, loop: GraphLoop, work: Callable[[], _Result]) -> _Result:
    """Call `work` on the callback thread and return or raise its result; without `deliver`, call it directly.

    Args:
        deliver: callback scheduler, as of `Node`.
        loop: loop that awaits the result.
        work: called once, possibly in another thread.
    """
    if deliver is None:
        return work()
    future: asyncio.Future[_Result] = asyncio.get_running_loop().create_future()

    def settle(result: Any, error: Exception | None) -> None:
        if future.done():
            return
        if error is None:
            future.set_result(result)
        else:
            future.set_exception(error)

    def call() -> Callable[[], object]:
        try:
            result, error = work(), None
        except Exception as failure:  # re-raised in the awaiting coroutine
            result, error = None, failure
        loop.call_soon(lambda: settle(result, error))
        return work

    deliver(call)
    return await future

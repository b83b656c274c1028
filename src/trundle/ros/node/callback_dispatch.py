"""Has work done where a node's callbacks run, and waits for it on the loop."""

import asyncio
from collections.abc import Callable
from typing import Any

from .loop import GraphLoop


async def run_on_callback_thread(
    deliver: Callable[[Callable[[], None]], None] | None, loop: GraphLoop, work: Callable[[], Any]
) -> Any:
    """Return what `work` returns, or raise what it raises; without `deliver` it is done here and now.

    Args:
        deliver: as of `Node`.
        loop: that this is a coroutine of.
        work: called once, maybe in another thread.
    """
    if deliver is None:
        return work()
    future: asyncio.Future[Any] = asyncio.get_running_loop().create_future()

    def settle(result: Any, error: Exception | None) -> None:
        if future.done():
            return
        if error is None:
            future.set_result(result)
        else:
            future.set_exception(error)

    def do() -> None:
        try:
            result, error = work(), None
        except Exception as failure:  # travels to whoever waits
            result, error = None, failure
        loop.call_soon(lambda: settle(result, error))

    deliver(do)
    return await future

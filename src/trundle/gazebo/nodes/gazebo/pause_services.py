"""/gazebo's services that pause, unpause and reset the simulation."""

from collections.abc import Callable
from typing import Any

from trundle.ros import Message, Node

from ..host import Simulator


def advertise_pause_services(node: Node, simulator: Simulator) -> None:
    """Advertise pause_physics, unpause_physics, reset_simulation and reset_world."""
    actions: dict[str, Callable[[], None]] = {
        "pause_physics": lambda: simulator.set_paused(True),
        "unpause_physics": lambda: simulator.set_paused(False),
        "reset_simulation": lambda: simulator.reset(time=True),
        "reset_world": lambda: simulator.reset(time=False),
    }
    for name, action in actions.items():
        node.advertise_service(f"~{name}", "std_srvs/Empty", _handler(action))


def _handler(action: Callable[[], None]) -> Callable[[Message], dict[str, Any]]:
    def handle(_request: Message) -> dict[str, Any]:
        action()
        return {}

    return handle

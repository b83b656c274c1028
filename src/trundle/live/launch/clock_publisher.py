"""/clock of a flat-out launch without a simulation: a tick whenever the nodes have settled."""

import threading

from trundle.ros import Node

from ..lockstep import Lockstep

_TICK_NS = 10_000_000
"""Gazebo's period of /clock [ns]."""
_IDLE_S = 0.005


class ClockPublisher:
    """Publishes /clock on its own thread, as fast as the nodes of this process can follow."""

    def __init__(self, node: Node, steps: Lockstep) -> None:
        """Start; time stays zero until the launch has begun.

        Args:
            node: publishes /clock.
            steps: holds time until the nodes have settled.
        """
        self._loop = node.loop
        self._publisher = node.advertise("/clock", "rosgraph_msgs/Clock", queue_size=10)
        self._steps = steps
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name="trundle-time", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop publishing."""
        self._ending.set()
        self._thread.join()

    def _run(self) -> None:
        time_ns, steps = 0, self._steps
        while not self._ending.is_set():
            if not steps.is_ready:
                self._ending.wait(_IDLE_S)
                continue
            time_ns = steps.target_ns(time_ns + _TICK_NS)
            self._publisher.publish({"clock": time_ns})
            steps.wait_settled(lambda: None, lambda: False, self._ending.is_set)
            steps.record_step(time_ns)

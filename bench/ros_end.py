"""One end of a topic, with Trundle's client library or rospy; `bench.graph` runs it as a program.

usage: ros_end.py trundle|rospy|modules  pub|sub|both|first  TYPE  COUNT  RATE_HZ (0: flat out)  QUEUE_SIZE (None, 1 …)

A subscriber prints one JSON object after COUNT messages, a publisher after sending them; with a queue size, which
drops messages, a publisher prints it when its standard input is closed. Stamps are `time.monotonic()`, which all
processes of a machine share.
"""

import json
import os
import site
import sys
import threading
import time
from collections.abc import Callable
from importlib import import_module
from typing import Any

_WARM_S = 1.0
_PIXELS = bytes(320 * 240 * 3)


class OverTrundle:
    """Trundle's client library."""

    def __init__(self, role: str, queue_size: int | None) -> None:
        _add_site()
        from trundle.ros import GraphLoop, Node

        self._queue_size = queue_size
        self._loop = GraphLoop()
        self._loop.start()
        self._node = Node(f"bench_{role}", loop=self._loop, rosout=False)

    def publisher(self, kind: str) -> tuple[Callable[[float], None], Callable[[], bool]]:
        """Return a function that publishes a message with a number, and one that checks for a subscriber."""
        publisher = self._node.advertise("/bench", kind, queue_size=self._queue_size)
        new = self._node.new
        if kind == "sensor_msgs/Image":
            image, header, stamp = type(new(kind)), type(new("std_msgs/Header")), type(new(kind).header.stamp)
            pixels = new(kind, {"data": _PIXELS}).data
            size = {"height": 240, "width": 320, "encoding": "rgb8", "is_bigendian": 0, "step": 960}

            def publish(number: float) -> None:
                del number
                publisher.publish(
                    image(header=header(seq=0, stamp=stamp(sec=0, nanosec=0), frame_id=""), **size, data=pixels)
                )

        else:
            twist, vector = type(new(kind)), type(new("geometry_msgs/Vector3"))

            def publish(number: float) -> None:
                publisher.publish(twist(linear=vector(number, 0.0, 0.0), angular=vector(0.0, 0.0, 0.0)))

        return publish, lambda: publisher.has_subscribers

    def subscribe(self, kind: str, callback: Callable[[Any], None]) -> None:
        """Call back with each message."""
        self._node.subscribe("/bench", kind, callback, queue_size=None)


class OverRospy:
    """rospy."""

    def __init__(self, role: str, queue_size: int | None) -> None:
        self._queue_size = queue_size
        self._rospy: Any = import_module("rospy")
        self._rospy.init_node(f"bench_{role}", disable_signals=True, disable_rosout=True)

    def publisher(self, kind: str) -> tuple[Callable[[float], None], Callable[[], bool]]:
        """Return a function that publishes a message with a number, and one that checks for a subscriber."""
        cls = _rospy_type(kind)
        publisher = self._rospy.Publisher("/bench", cls, queue_size=self._queue_size)

        def publish(number: float) -> None:
            if kind == "sensor_msgs/Image":
                publisher.publish(cls(height=240, width=320, encoding="rgb8", step=960, data=_PIXELS))
            else:
                message = cls()
                message.linear.x = number
                publisher.publish(message)

        def has_subscriber() -> bool:
            return bool(publisher.get_num_connections())

        return publish, has_subscriber

    def subscribe(self, kind: str, callback: Callable[[Any], None]) -> None:
        """Call back with each message."""
        self._rospy.Subscriber("/bench", _rospy_type(kind), callback)


class OverModules(OverRospy):
    """Trundle's rospy modules."""

    def __init__(self, role: str, queue_size: int | None) -> None:
        _add_site()
        from trundle.ros.rospy.finder import install

        install()
        super().__init__(role, queue_size)


def _add_site() -> None:
    if sys.flags.no_site:  # another interpreter, without Trundle in its site-packages
        site.addsitedir(os.environ["BENCH_SITE"])


def _rospy_type(kind: str) -> Any:
    package, _, name = kind.partition("/")
    return getattr(import_module(f"{package}.msg"), name)


class Receiver:
    """Callback of a subscriber that counts messages after the first one, which warms up."""

    def __init__(self, count: int, *, are_stamped: bool) -> None:
        self._count, self._are_stamped = count, are_stamped
        self._ages: list[float] = []
        self._received = -1
        self._start = self._start_cpu = 0.0
        self._done = threading.Event()

    def __call__(self, message: Any) -> None:
        """Count a message."""
        self._received += 1
        if self._received == 1:
            self._start, self._start_cpu = time.monotonic(), time.process_time()
        if self._are_stamped and self._received:
            self._ages.append(time.monotonic() - message.linear.x)
        if self._received == self._count:
            self._done.set()

    def result(self) -> dict[str, Any]:
        """Wait for all messages; return their ages, and the times from the first message to the last."""
        self._done.wait()
        times = {"end": time.monotonic(), "first": self._start, "sub_cpu": time.process_time() - self._start_cpu}
        return {**times, "ages": self._ages}


def main() -> None:
    """Run the ends named on the command line."""
    library, role, kind, count, rate_hz, queue = sys.argv[1:]
    queue_size = None if queue == "None" else int(queue)
    end = {"trundle": OverTrundle, "rospy": OverRospy, "modules": OverModules}[library](role, queue_size)
    total, period_s = int(count), 1 / float(rate_hz) if float(rate_hz) else 0.0
    receiver = Receiver(total, are_stamped=bool(period_s))
    closed = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), closed.set()), daemon=True).start()
    result: dict[str, Any] = {}
    if role == "first":
        publish, has_subscriber = end.publisher(kind)
        while not has_subscriber():
            time.sleep(0.001)
        publish(0.0)
    if role in ("sub", "both"):
        end.subscribe(kind, receiver)
    if role not in ("sub", "first"):
        publish, has_subscriber = end.publisher(kind)
        while not has_subscriber():
            time.sleep(0.01)
        publish(time.monotonic())  # the first message warms up
        time.sleep(_WARM_S)
        result |= _publish(publish, None if queue_size else total, period_s, closed)
    if role in ("sub", "both"):
        result |= receiver.result()
    print(json.dumps(result), flush=True)
    closed.wait()  # run until the parent process has the result


def _publish(
    publish: Callable[[float], None], total: int | None, period_s: float, closed: threading.Event
) -> dict[str, float]:
    """Publish `total` messages, or until standard input is closed; return start and CPU time [s]."""
    start, cpu = time.monotonic(), time.process_time()
    due, sent = start, 0
    while sent != total and not closed.is_set():
        if period_s:
            due += period_s
            time.sleep(max(0.0, due - time.monotonic()))
        publish(time.monotonic())
        sent += 1
    return {"start": start, "pub_cpu": time.process_time() - cpu, "sent": sent}


if __name__ == "__main__":
    main()

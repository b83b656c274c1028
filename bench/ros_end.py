"""One end of a topic, over Trundle's graph or over rospy; `bench.graph` runs it as a program.

usage: ros_end.py trundle|rospy|modules  pub|sub|both|first  Twist|Image  COUNT  RATE_HZ (0: flat out)

A subscriber prints one JSON object when it has COUNT messages, a publisher when it has sent them; stamps are
`time.monotonic()`, which all processes of a machine share.
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
    """Trundle's own client library."""

    def __init__(self, role: str) -> None:
        _add_site()
        from trundle.ros import GraphLoop, Node

        self._loop = GraphLoop()
        self._loop.start()
        self._node = Node(f"bench_{role}", loop=self._loop, rosout=False)

    def publisher(self, kind: str) -> tuple[Callable[[float], None], Callable[[], bool]]:
        """Return functions that publish a message with a number, and check for a subscriber."""
        publisher = self._node.advertise("/bench", kind, queue_size=None)
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

    def __init__(self, role: str) -> None:
        self._rospy: Any = import_module("rospy")
        self._rospy.init_node(f"bench_{role}", disable_signals=True, disable_rosout=True)

    def publisher(self, kind: str) -> tuple[Callable[[float], None], Callable[[], bool]]:
        """Return functions that publish a message with a number, and check for a subscriber."""
        cls = _rospy_type(kind)
        publisher = self._rospy.Publisher("/bench", cls, queue_size=0)

        def publish(number: float) -> None:
            if kind == "sensor_msgs/Image":
                publisher.publish(cls(height=240, width=320, encoding="rgb8", step=960, data=_PIXELS))
            else:
                message = cls()
                message.linear.x = number
                publisher.publish(message)

        def is_heard() -> bool:
            return bool(publisher.get_num_connections())

        return publish, is_heard

    def subscribe(self, kind: str, callback: Callable[[Any], None]) -> None:
        """Call back with each message."""
        self._rospy.Subscriber("/bench", _rospy_type(kind), callback)


class OverModules(OverRospy):
    """Trundle's rospy."""

    def __init__(self, role: str) -> None:
        _add_site()
        from trundle.rospy.finder import install

        install()
        super().__init__(role)


def _add_site() -> None:
    if sys.flags.no_site:  # an interpreter that has Trundle elsewhere
        site.addsitedir(os.environ["BENCH_SITE"])


def _rospy_type(kind: str) -> Any:
    package, _, name = kind.partition("/")
    return getattr(import_module(f"{package}.msg"), name)


def main() -> None:
    """Run the ends that the command line names."""
    library, role, kind, count, rate_hz = sys.argv[1:]
    end = {"trundle": OverTrundle, "rospy": OverRospy, "modules": OverModules}[library](role)
    total, period_s = int(count), 1 / float(rate_hz) if float(rate_hz) else 0.0
    ages: list[float] = []
    done = threading.Event()

    def take(message: Any) -> None:
        ages.append(time.monotonic() - message.linear.x if period_s else 0.0)
        if len(ages) > total:
            done.set()

    said: dict[str, Any] = {}
    if role == "first":
        publish, is_heard = end.publisher(kind)
        while not is_heard():
            time.sleep(0.001)
        publish(0.0)
    if role in ("sub", "both"):
        end.subscribe(kind, take)
    if role not in ("sub", "first"):
        publish, is_heard = end.publisher(kind)
        while not is_heard():
            time.sleep(0.01)
        publish(time.monotonic())  # the first one warms up
        time.sleep(_WARM_S)
        said["start"] = due = time.monotonic()
        for _ in range(total):
            if period_s:
                due += period_s
                time.sleep(max(0.0, due - time.monotonic()))
            publish(time.monotonic())
    if role in ("sub", "both"):
        done.wait()
        said |= {"end": time.monotonic(), "ages": ages[1:] if period_s else []}
    print(json.dumps(said), flush=True)
    sys.stdin.read()  # stay until the parent process has its result


if __name__ == "__main__":
    main()

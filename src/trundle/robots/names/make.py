"""Generated ROS names: anonymous ones, and legal ones from SDF names."""

import os
import re
import time
from collections.abc import Iterable

_ILLEGAL = re.compile(r"[^A-Za-z0-9_]")


def anonymous_name(base: str) -> str:
    """Create a unique name: base_host_pid_milliseconds, as rospy does."""
    import socket  # lazy: only this function needs it

    return _ILLEGAL.sub("_", f"{base}_{socket.gethostname()}_{os.getpid()}_{int(time.time() * 1000)}")


def ros_name(sdf_name: str) -> str:
    """Convert an SDF name to a legal ROS name.

    `::` and `/` separate namespaces; in each part, characters other than letters, digits and `_` become `_`, and a part
    that does not begin with a letter gets the prefix `n_`. Legal names stay unchanged.
    """
    parts = [_ILLEGAL.sub("_", part) for part in re.split(r"::|/", sdf_name) if part]
    legal = [part if part[0].isalpha() else f"n_{part}" for part in parts]
    return ("/" if sdf_name.startswith("/") else "") + "/".join(legal or ["unnamed"])


def ros_names(sdf_names: Iterable[str]) -> dict[str, str]:
    """Convert SDF names to distinct legal ROS names: the second `left_arm` becomes `left_arm_2`."""
    names = list(dict.fromkeys(sdf_names))
    used = {name for name in names if ros_name(name) == name}
    result: dict[str, str] = {}
    for name in names:
        legal = ros_name(name)
        candidate, count = legal, 1
        while candidate in used and candidate != name:
            count += 1
            candidate = f"{legal}_{count}"
        used.add(candidate)
        result[name] = candidate
    return result

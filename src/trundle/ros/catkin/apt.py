"""Debian's packages of ROS 1, also in Ubuntu (https://wiki.ros.org/UpstreamPackages)."""

import subprocess
from collections.abc import Iterable

_PATTERNS = ("lib{}-dev", "ros-{}", "{}", "python3-{}")
_RENAMED = {"boost": "libboost-all-dev"}
"""Libraries whose packages match none of the patterns."""


def debian_packages(requirements: Iterable[str]) -> dict[str, str]:
    """Return the apt package of each name that CMake must find, if this machine's apt has one.

    Args:
        requirements: names of ROS packages and libraries; roscpp is in libroscpp-dev, Eigen3 in libeigen3-dev.
    """
    try:
        listed = subprocess.run(["apt-cache", "pkgnames"], capture_output=True, text=True, check=False).stdout
    except OSError:
        return {}
    available = set(listed.split())
    packages: dict[str, str] = {}
    for name in requirements:
        plain = name.lower().replace("_", "-")
        candidates = [_RENAMED.get(plain, ""), *(pattern.format(plain) for pattern in _PATTERNS)]
        package = next((candidate for candidate in candidates if candidate in available), None)
        if package is not None:
            packages[name] = package
    return packages

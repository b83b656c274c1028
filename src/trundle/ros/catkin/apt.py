"""Debian's own packages of ROS 1, which Ubuntu has, too (https://wiki.ros.org/UpstreamPackages)."""

import subprocess
from collections.abc import Iterable

_FORMS = ("lib{}-dev", "ros-{}", "{}", "python3-{}")
_RENAMED = {"boost": "libboost-all-dev"}
"""Libraries that CMake names otherwise than any of the forms."""


def debian_packages(requirements: Iterable[str]) -> dict[str, str]:
    """Return apt's package for each name that CMake has to find, as far as this machine's apt knows one.

    Args:
        requirements: names of ROS packages and libraries; roscpp is in libroscpp-dev, Eigen3 in libeigen3-dev.
    """
    try:
        listed = subprocess.run(["apt-cache", "pkgnames"], capture_output=True, text=True, check=False).stdout
    except OSError:
        return {}
    known = set(listed.split())
    found: dict[str, str] = {}
    for name in requirements:
        plain = name.lower().replace("_", "-")
        forms = [_RENAMED.get(plain, ""), *(form.format(plain) for form in _FORMS)]
        package = next((form for form in forms if form in known), None)
        if package is not None:
            found[name] = package
    return found

"""Facts about one repository."""

from typing import NamedTuple

ROSDISTROS = ("hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic")
"""Distributions of ROS 1 in the index, oldest first."""


class Entry(NamedTuple):
    """Repository with the packages that one or more distributions release from it."""

    url: str
    branches: dict[str, str]
    """Distribution → branch; '' is the repository's default branch."""
    packages: tuple[str, ...]


def nearest_distros(distro: str) -> list[str]:
    """Return all distributions, nearest to one first; of two equally near ones the older, which has fewer changes."""
    position = ROSDISTROS.index(distro)
    return sorted(ROSDISTROS, key=lambda other: abs(ROSDISTROS.index(other) - position))

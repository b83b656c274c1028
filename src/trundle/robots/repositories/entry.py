"""Index entry of a repository."""

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
    """Return all distributions, sorted by distance from one; of two at equal distance the older is first."""
    position = ROSDISTROS.index(distro)
    return sorted(ROSDISTROS, key=lambda other: abs(ROSDISTROS.index(other) - position))

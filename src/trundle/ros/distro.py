"""Where ROS distributions differ: one table, chosen by `--distro`, or by what a running master says it is.

Each distribution is taken as its last release left it. The changelogs named are those at
https://docs.ros.org/en/DISTRO/changelogs/PACKAGE/changelog.html.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Distro:
    """How one distribution behaves."""

    distro: str
    """What /rosdistro says."""
    version: str
    """What /rosversion says: a late version of ros_comm (changelog of roslaunch)."""
    use_tf_static: bool
    """robot_state_publisher's default; false: fixed joints are sent on /tf again and again.

    True since its 1.12.0, of Jade, "publish fixed joints over tf_static by default" (changelog, #37 and #56).
    """
    publishes_empty_joint_states: bool
    """joint_state_publisher sends messages without joints; not since its 1.12.12, of Kinetic (changelog, #212)."""
    planar_is_free: bool
    """joint_state_publisher moves planar joints; not since its 1.12.14, of Kinetic (changelog, #14)."""
    mirrored_diff_drive: bool
    """gazebo_ros_diff_drive takes the left wheel for the right one where <legacyMode> is not given.

    So up to Kinetic; not since gazebo_plugins 2.8.3, of Melodic (changelog, #707).
    """
    has_clock_frequency: bool
    """/gazebo/pub_clock_frequency slows /clock down; not before gazebo_ros 2.5.4, of Jade (changelog).

    Without it /clock ticks at each step in every distribution (GazeboRosApiPlugin::publishSimTime).
    """


_INDIGO = Distro(
    distro="indigo",
    version="1.11.21",
    use_tf_static=False,
    publishes_empty_joint_states=True,
    planar_is_free=True,
    mirrored_diff_drive=True,
    has_clock_frequency=False,
)
_LATER = {
    "use_tf_static": True,
    "publishes_empty_joint_states": False,
    "planar_is_free": False,
    "has_clock_frequency": True,
}
DISTROS: dict[str, Distro] = {
    profile.distro: profile
    for profile in (
        _INDIGO,
        Distro(distro="kinetic", version="1.12.17", mirrored_diff_drive=True, **_LATER),
        Distro(distro="melodic", version="1.14.13", mirrored_diff_drive=False, **_LATER),
        Distro(distro="noetic", version="1.16.0", mirrored_diff_drive=False, **_LATER),
    )
}
"""Every distribution that can be asked for."""

NOETIC = DISTROS["noetic"]
"""What is meant where nobody says."""

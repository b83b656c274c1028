"""Differences between ROS distributions: one table, chosen by `--distro` or by a running master's /rosdistro.

The values are those of each distribution's last release. The cited changelogs are at
https://docs.ros.org/en/DISTRO/changelogs/PACKAGE/changelog.html.
"""

from typing import NamedTuple


class Distro(NamedTuple):
    """Behaviour of one distribution."""

    distro: str
    """Value of /rosdistro."""
    version: str
    """Value of /rosversion: a late version of ros_comm (changelog of roslaunch)."""
    use_tf_static: bool
    """robot_state_publisher's default; False: fixed joints are published on /tf periodically.

    True since its 1.12.0, of Jade, "publish fixed joints over tf_static by default" (changelog, #37 and #56).
    """
    publishes_empty_joint_states: bool
    """True if joint_state_publisher sends messages without joints; not since its 1.12.12, of Kinetic (changelog,
    #212).
    """
    planar_is_free: bool
    """True if joint_state_publisher moves planar joints; not since its 1.12.14, of Kinetic (changelog, #14)."""
    mirrored_diff_drive: bool
    """True if gazebo_ros_diff_drive swaps the left and right wheels where <legacyMode> is not given.

    True up to Kinetic; not since gazebo_plugins 2.8.3, of Melodic (changelog, #707).
    """
    namespace_is_tf_prefix: bool
    """True if a namespace without tf_prefix is the prefix of its plugins' frames (diff_drive, camera, laser …); not
    since gazebo_plugins 2.9.2, of Noetic (changelog, #1143 and #1173).
    """
    imu_reference_is_first_pose: bool
    """True if gazebo_ros_imu_sensor without <initialOrientationAsReference> measures from the imu's first pose; not
    since gazebo_plugins 2.9.0, of Noetic, "comply with REP 145 by default" (changelog).
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
    namespace_is_tf_prefix=True,
    imu_reference_is_first_pose=True,
    has_clock_frequency=False,
)
_LATER = {
    "use_tf_static": True,
    "publishes_empty_joint_states": False,
    "planar_is_free": False,
    "has_clock_frequency": True,
}
_BEFORE_NOETIC = {**_LATER, "namespace_is_tf_prefix": True, "imu_reference_is_first_pose": True}
DISTROS: dict[str, Distro] = {
    profile.distro: profile
    for profile in (
        _INDIGO,
        Distro(distro="kinetic", version="1.12.17", mirrored_diff_drive=True, **_BEFORE_NOETIC),
        Distro(distro="melodic", version="1.14.13", mirrored_diff_drive=False, **_BEFORE_NOETIC),
        Distro(
            distro="noetic",
            version="1.16.0",
            mirrored_diff_drive=False,
            namespace_is_tf_prefix=False,
            imu_reference_is_first_pose=False,
            **_LATER,
        ),
    )
}
"""Supported distributions by name."""

NOETIC = DISTROS["noetic"]
"""Default distribution."""

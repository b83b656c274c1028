"""Where stand-ins differ between ROS distributions: one table, chosen by `--distro`."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Profile:
    """How the stock nodes of one distribution behave."""

    distro: str
    version: str
    """What /rosversion says: the version of ros_comm."""
    use_tf_static: bool
    """robot_state_publisher's default; false: fixed joints are sent on /tf again and again. True since Jade."""
    floating_is_fixed: bool
    """robot_state_publisher holds floating joints at their origin; later ones leave them to others."""
    publishes_empty_joint_states: bool
    """joint_state_publisher sends messages without joints; Noetic's does not."""
    planar_is_free: bool
    """joint_state_publisher moves planar joints, which Noetic's skips."""


PROFILES: dict[str, Profile] = {
    profile.distro: profile
    for profile in (
        Profile(
            distro="indigo",
            version="1.11.21",
            use_tf_static=False,
            floating_is_fixed=True,
            publishes_empty_joint_states=True,
            planar_is_free=True,
        ),
        Profile(
            distro="kinetic",
            version="1.12.17",
            use_tf_static=True,
            floating_is_fixed=False,
            publishes_empty_joint_states=True,
            planar_is_free=True,
        ),
        Profile(
            distro="melodic",
            version="1.14.13",
            use_tf_static=True,
            floating_is_fixed=False,
            publishes_empty_joint_states=True,
            planar_is_free=True,
        ),
        Profile(
            distro="noetic",
            version="1.16.0",
            use_tf_static=True,
            floating_is_fixed=False,
            publishes_empty_joint_states=False,
            planar_is_free=False,
        ),
    )
}
"""Every distribution that can be asked for."""

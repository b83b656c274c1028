"""Kinematics of four mecanum wheels, whose rollers form an X seen from above."""

from msgspec import Struct

from .four_wheel import Wheels


class MecanumDrive(Struct, frozen=True, kw_only=True):
    """Robot with four mecanum wheels at the corners of a rectangle.

    Equations: Taheri, Qiao and Ghaeminezhad, "Kinematic Model of a Four Mecanum Wheeled Mobile Robot", 2015.
    """

    radius: float
    """Wheel radius [m]."""
    reach: float
    """Half the wheelbase plus half the track [m]."""

    def wheel_speeds(self, forward: float, left: float, turning: float) -> Wheels:
        """Return wheel speeds [rad/s] for a twist: speeds forward and to the left [m/s], yaw rate [rad/s]."""
        turn = turning * self.reach
        return (
            (forward - left - turn) / self.radius,
            (forward + left + turn) / self.radius,
            (forward + left - turn) / self.radius,
            (forward - left + turn) / self.radius,
        )

    def twist(self, speeds: Wheels) -> tuple[float, float, float]:
        """Return the twist of wheel speeds [rad/s], as in `wheel_speeds`; the least-squares fit if wheels slip."""
        front_left, front_right, rear_left, rear_right = (speed * self.radius / 4.0 for speed in speeds)
        return (
            front_left + front_right + rear_left + rear_right,
            -front_left + front_right + rear_left - rear_right,
            (-front_left + front_right - rear_left + rear_right) / self.reach,
        )

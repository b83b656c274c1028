"""PID law of Gazebo with a clamped integral; a positive error gives a negative command."""

from msgspec import Struct


class Pid(Struct, kw_only=True):
    """PID controller for error = actual − desired."""

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_min: float = 0.0
    i_max: float = 0.0
    """Limits of the integral term."""
    low: float = 0.0
    high: float = -1.0
    """Limits of the command; unlimited if high < low, as in Gazebo."""
    _integral: float = 0.0
    _last: float = 0.0

    def reset(self) -> None:
        """Clear the integral and the last error."""
        self._integral = self._last = 0.0

    def command(self, error: float, dt: float) -> float:
        """Return the command for error = actual − desired, dt [s] after the last; as in Gazebo, the first derivative
        sees a jump.
        """
        if dt <= 0.0:
            return 0.0
        self._integral += error * dt
        part = self.i * self._integral
        clamped = min(max(part, self.i_min), self.i_max)
        if clamped != part:
            self._integral = clamped / self.i
        slope, self._last = (error - self._last) / dt, error
        command = -(self.p * error + clamped + self.d * slope)
        return min(max(command, self.low), self.high) if self.high >= self.low else command

"""A PID law with a clamped integral, of one sign with the error."""

from msgspec import Struct


class Pid(Struct, kw_only=True):
    """Turns an error into a command; what is too large is wanted smaller."""

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_min: float = 0.0
    i_max: float = 0.0
    """What the integral may contribute."""
    low: float = 0.0
    high: float = -1.0
    """What the command may be; any, where high is below low, as in Gazebo."""
    _integral: float = 0.0
    _last: float = 0.0

    def reset(self) -> None:
        """Forget every error."""
        self._integral = self._last = 0.0

    def command(self, error: float, dt: float) -> float:
        """The command for what is minus what is wanted, dt [s] after the last; as in Gazebo the first d sees a jump."""
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

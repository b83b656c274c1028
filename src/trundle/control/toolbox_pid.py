"""PID law of ros_control's controllers (control_toolbox)."""

from msgspec import Struct


class ToolboxPid(Struct, kw_only=True):
    """PID controller for error = desired − actual, with control_toolbox's gains."""

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_clamp: float = 0.0
    """Limit of the integral term's magnitude."""
    antiwindup: bool = False
    """True if the integral itself is clamped; else only its contribution."""
    _integral: float = 0.0
    _last: float = 0.0

    def reset(self) -> None:
        """Clear the integral and the last error."""
        self._integral = self._last = 0.0

    def command(self, error: float, dt: float, *, slope: float | None = None) -> float:
        """Return the command, dt [s] after the last.

        Args:
            error: desired − actual.
            dt: since the last command.
            slope: derivative of the error [1/s]; None: from the last error, which is 0 before the first.
        """
        if dt <= 0.0:
            return 0.0
        if slope is None:
            slope = (error - self._last) / dt
        self._last = error
        self._integral += error * dt
        if self.antiwindup and self.i:
            most = abs(self.i_clamp / self.i)
            self._integral = min(max(self._integral, -most), most)
        contribution = min(max(self.i * self._integral, -self.i_clamp), self.i_clamp)
        return self.p * error + contribution + self.d * slope

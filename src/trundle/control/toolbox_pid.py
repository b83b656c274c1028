"""The PID law of ros_control's controllers."""

from msgspec import Struct


class ToolboxPid(Struct, kw_only=True):
    """Turns the error, what is wanted less what is, into a command; control_toolbox's, gain by gain."""

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_clamp: float = 0.0
    """What the integral may contribute, of either sign."""
    antiwindup: bool = False
    """Whether the integral itself stops growing there; else only what it contributes."""
    _integral: float = 0.0
    _last: float = 0.0

    def reset(self) -> None:
        """Forget every error."""
        self._integral = self._last = 0.0

    def command(self, error: float, dt: float, *, slope: float | None = None) -> float:
        """The command dt [s] after the last.

        Args:
            error: wanted less actual.
            dt: since the last command.
            slope: of the error [1/s]; None: by the last error, which was 0 before the first.
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

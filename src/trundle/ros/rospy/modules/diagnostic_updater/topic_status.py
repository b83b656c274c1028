"""Tasks that check the frequency of events, and the age of their stamps."""

import threading
from collections.abc import Mapping
from typing import Any

import genpy
import rospy

from .status import ERROR, OK, WARN
from .tasks import DiagnosticTask


class FrequencyStatusParam:
    """Limits of a frequency."""

    def __init__(self, freq_bound: Mapping[str, float], tolerance: float = 0.1, window_size: int = 5) -> None:
        """Set the limits.

        Args:
            freq_bound: {'min': [Hz], 'max': [Hz]}; 'max' may be missing.
            tolerance: ratio by which they may be exceeded.
            window_size: number of updates over which the frequency is measured.
        """
        self.freq_bound = freq_bound
        self.tolerance = tolerance
        self.window_size = window_size


class FrequencyStatus(DiagnosticTask):
    """Compares the frequency of `tick` with its limits."""

    def __init__(self, params: FrequencyStatusParam, name: str = "FrequencyStatus") -> None:
        super().__init__(name)
        self.params = params
        self.lock = threading.Lock()
        self.clear()

    def clear(self) -> None:
        """Restart counting."""
        with self.lock:
            self.count = 0
            self.times: list[genpy.Time] = [rospy.Time.now()] * self.params.window_size
            self.seq_nums = [0] * self.params.window_size
            self.hist_indx = 0

    def tick(self) -> None:
        """Count an event."""
        with self.lock:
            self.count += 1

    def run(self, stat: Any) -> Any:
        """Fill a status."""
        with self.lock:
            now, index = rospy.Time.now(), self.hist_indx
            events = self.count - self.seq_nums[index]
            window = (now - self.times[index]).to_sec()
            frequency = events / window if window else 0.0
            self.seq_nums[index], self.times[index] = self.count, now
            self.hist_indx = (index + 1) % self.params.window_size
        bounds, tolerance = self.params.freq_bound, self.params.tolerance
        min_frequency = bounds["min"] * (1 - tolerance)
        max_frequency = bounds["max"] * (1 + tolerance) if "max" in bounds else None
        if events == 0:
            stat.summary(ERROR, "No events recorded.")
        elif frequency < min_frequency:
            stat.summary(WARN, "Frequency too low.")
        elif max_frequency is not None and frequency > max_frequency:
            stat.summary(WARN, "Frequency too high.")
        else:
            stat.summary(OK, "Desired frequency met")
        stat.add("Events in window", f"{events}")
        stat.add("Events since startup", f"{self.count}")
        stat.add("Duration of window (s)", f"{window:f}")
        stat.add("Actual frequency (Hz)", f"{frequency:f}")
        if bounds.get("max") == bounds["min"]:
            stat.add("Target frequency (Hz)", f"{bounds['min']:f}")
        if bounds["min"] > 0:
            stat.add("Minimum acceptable frequency (Hz)", f"{min_frequency:f}")
        if max_frequency is not None:
            stat.add("Maximum acceptable frequency (Hz)", f"{max_frequency:f}")
        return stat


class TimeStampStatusParam:
    """Limits of the age of stamps [s]."""

    def __init__(self, min_acceptable: float = -1, max_acceptable: float = 5) -> None:
        self.max_acceptable = max_acceptable
        self.min_acceptable = min_acceptable


_DEFAULT_LIMITS = TimeStampStatusParam()


class TimeStampStatus(DiagnosticTask):
    """Compares the age of stamps with its limits."""

    def __init__(self, params: TimeStampStatusParam = _DEFAULT_LIMITS, name: str = "Timestamp Status") -> None:
        super().__init__(name)
        self.params = params
        self.lock = threading.Lock()
        self.early_count = self.late_count = self.zero_count = 0
        self._clear_deltas()

    def _clear_deltas(self) -> None:
        self.zero_seen = False
        self.min_delta: float = 0
        self.max_delta: float = 0
        self.deltas_valid = False

    def tick(self, stamp: genpy.Time | float) -> None:
        """Record a stamp, a rospy.Time or seconds."""
        stamp_s = stamp.to_sec() if isinstance(stamp, genpy.TVal) else stamp
        with self.lock:
            if stamp_s == 0:
                self.zero_seen = True
                return
            delta = rospy.Time.now().to_sec() - stamp_s
            self.max_delta = max(delta, self.max_delta) if self.deltas_valid else delta
            self.min_delta = min(delta, self.min_delta) if self.deltas_valid else delta
            self.deltas_valid = True

    def run(self, stat: Any) -> Any:
        """Fill a status from the stamps since the last one."""
        with self.lock:
            stat.summary(OK, "Timestamps are reasonable.")
            if not self.deltas_valid:
                stat.summary(WARN, "No data since last update.")
            else:
                if self.min_delta < self.params.min_acceptable:
                    stat.summary(ERROR, "Timestamps too far in future seen.")
                    self.early_count += 1
                if self.max_delta > self.params.max_acceptable:
                    stat.summary(ERROR, "Timestamps too far in past seen.")
                    self.late_count += 1
                if self.zero_seen:
                    stat.summary(ERROR, "Zero timestamp seen.")
                    self.zero_count += 1
            stat.add("Earliest timestamp delay:", f"{self.min_delta:f}")
            stat.add("Latest timestamp delay:", f"{self.max_delta:f}")
            stat.add("Earliest acceptable timestamp delay:", f"{self.params.min_acceptable:f}")
            stat.add("Latest acceptable timestamp delay:", f"{self.params.max_acceptable:f}")
            stat.add("Late diagnostic update count:", f"{self.late_count}")
            stat.add("Early diagnostic update count:", f"{self.early_count}")
            stat.add("Zero seen diagnostic update count:", f"{self.zero_count}")
            self._clear_deltas()
        return stat


class Heartbeat(DiagnosticTask):
    """Always OK while the node runs."""

    def __init__(self) -> None:
        super().__init__("Heartbeat")

    def run(self, stat: Any) -> Any:
        """Fill a status."""
        stat.summary(OK, "Alive")
        return stat

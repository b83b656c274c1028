"""Angles on the circle [rad]."""

from math import fmod, pi

_TURN = 2.0 * pi


def normalize_angle_positive(angle: float) -> float:
    """The same angle in [0, 2π)."""
    return fmod(fmod(angle, _TURN) + _TURN, _TURN)


def normalize_angle(angle: float) -> float:
    """The same angle in (-π, π]."""
    positive = normalize_angle_positive(angle)
    return positive - _TURN if positive > pi else positive


def shortest_angular_distance(from_angle: float, to_angle: float) -> float:
    """Shortest turn from one angle to another, in (-π, π]."""
    return normalize_angle(to_angle - from_angle)


def two_pi_complement(angle: float) -> float:
    """Turn in the other direction that leads to the same angle."""
    if abs(angle) > _TURN:
        angle = fmod(angle, _TURN)
    return angle - _TURN if angle > 0 else angle + _TURN


def shortest_angular_distance_with_limits(
    from_angle: float, to_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float]:
    """Shortest turn that stays between two limits.

    Args:
        from_angle: start, in [-π, π).
        to_angle: end.
        left_limit: lower limit, in [-π, π].
        right_limit: upper limit, in [-π, π]; if it is below the left one, the interval crosses ±π.

    Returns:
        (True, turn), or (False, turn) if an end is outside the limits; the turn then leads further into the allowed
        interval.
    """
    is_inside, lowest, highest = _find_min_max_delta(from_angle, left_limit, right_limit)
    short = shortest_angular_distance(from_angle, to_angle)
    turns = (short, two_pi_complement(short))
    if is_inside:
        for turn in turns:
            if lowest <= turn <= highest:
                return True, turn
        _, lowest, highest = _find_min_max_delta(to_angle, left_limit, right_limit)
        towards = max, min
    else:
        towards = min, max
    if abs(lowest) < abs(highest):
        return False, towards[0](turns)
    if abs(lowest) > abs(highest):
        return False, towards[1](turns)
    return False, min(turns[::-1], key=abs)


def shortest_angular_distance_with_large_limits(
    from_angle: float, to_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float]:
    """Shortest turn that stays between two limits of any size; (is possible, turn)."""
    short = shortest_angular_distance(from_angle, to_angle)
    turns = sorted((short, two_pi_complement(short)), key=abs)
    if left_limit <= right_limit:
        for turn in turns:
            if left_limit <= from_angle + turn <= right_limit:
                return left_limit <= from_angle <= right_limit, turn
    return False, turns[0]


def _find_min_max_delta(from_angle: float, left_limit: float, right_limit: float) -> tuple[bool, float, float]:
    """(is inside, minimum turn, maximum turn) from an angle to its limits."""
    left = shortest_angular_distance(from_angle, left_limit)
    right = shortest_angular_distance(from_angle, right_limit)
    other_left, other_right = two_pi_complement(left), two_pi_complement(right)
    if left == 0:
        return True, left, max(right, other_right)
    if right == 0:
        return True, min(left, other_left), right
    lowest, max_left = min(left, other_left), max(left, other_left)
    highest, min_right = max(right, other_right), min(right, other_right)
    if lowest <= min_right or highest >= max_left:
        return left_limit == -pi and right_limit == pi, min_right, max_left
    return True, lowest, highest

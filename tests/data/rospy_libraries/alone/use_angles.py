"""angles: all functions over a grid."""

import itertools
import math

import angles

GRID = [-7.5, -1.0, 0.0, 0.25, math.pi]
for a in GRID:
    print(
        round(angles.normalize_angle(a), 9),
        round(angles.normalize_angle_positive(a), 9),
        round(angles.two_pi_complement(a), 9),
    )
INSIDE = [a for a in GRID if -math.pi <= a <= math.pi]
for a, b in itertools.product(GRID, GRID):
    print(round(angles.shortest_angular_distance(a, b), 9) + 0.0)
for a, b, c, d in itertools.product(INSIDE, INSIDE, INSIDE, INSIDE):
    ok, turn = angles.shortest_angular_distance_with_limits(a, b, c, d)
    print(a, b, c, d, bool(ok), round(turn, 9) + 0.0)
for a, b, c, d in itertools.product(GRID, repeat=4):
    ok, turn = angles.shortest_angular_distance_with_large_limits(a, b, c, d)
    print(bool(ok), round(turn, 9) + 0.0)

"""Planners by the names of OMPL, CHOMP, STOMP and TrajOpt; those that there are not are answered by the nearest."""

from typing import Literal, TypeAlias

Algorithm: TypeAlias = Literal["RRTConnect", "RRT", "RRTstar", "PRM", "PRMstar"]
ALGORITHMS: dict[Algorithm, int] = {"RRTConnect": 0, "RRT": 1, "RRTstar": 2, "PRM": 3, "PRMstar": 4}
"""Planners, with their numbers in `_planning`."""
_NEAREST: dict[str, Algorithm] = {
    "LazyPRM": "PRM",
    "LazyPRMstar": "PRMstar",
    "SPARS": "PRM",
    "SPARStwo": "PRM",
    "FMT": "PRMstar",
    "BFMT": "PRMstar",
    "TRRT": "RRTstar",
    "BiTRRT": "RRTConnect",
    "LBTRRT": "RRTstar",
    "AnytimePathShortening": "RRTConnect",
    "SBL": "RRTConnect",
    "EST": "RRTConnect",
    "BiEST": "RRTConnect",
    "ProjEST": "RRTConnect",
    "KPIECE": "RRTConnect",
    "KPIECE1": "RRTConnect",
    "BKPIECE": "RRTConnect",
    "BKPIECE1": "RRTConnect",
    "LBKPIECE": "RRTConnect",
    "LBKPIECE1": "RRTConnect",
    "PDST": "RRTConnect",
    "STRIDE": "RRTConnect",
    "CHOMP": "RRTConnect",
    "STOMP": "RRTConnect",
    "TrajOpt": "RRTConnect",
}
SEQUENTIAL = ("PTP", "LIN", "CIRC")
"""Planners of pilz_industrial_motion_planner."""


def find_algorithm(planner: str) -> tuple[Algorithm, str]:
    """Return the algorithm for a planner's name, and a sentence if it is another one; "" if it is the same."""
    name = planner.removeprefix("geometric::").removesuffix("kConfigDefault")
    if not name:
        return "RRTConnect", ""
    for algorithm in ALGORITHMS:
        if name.lower() == algorithm.lower():
            return algorithm, ""
    for known, algorithm in _NEAREST.items():
        if name.lower() == known.lower():
            return algorithm, f"there is no {known}; {algorithm} planned, which answers the same requests"
    known_names = ", ".join([*ALGORITHMS, *SEQUENTIAL])
    return "RRTConnect", f"no planner {planner!r}; RRTConnect planned; there are: {known_names}"

"""States of a goal at its client, and the transitions that a server's status causes."""

from actionlib_msgs.msg import GoalStatus


def get_name_of_constant(C: type, n: int) -> str:
    """Name of the constant of class `C` that has the value `n`."""
    for name, value in C.__dict__.items():
        if isinstance(value, int) and value == n:
            return name
    return f"NO_SUCH_STATE_{n}"


class CommState:
    """State of a goal."""

    WAITING_FOR_GOAL_ACK = 0
    PENDING = 1
    ACTIVE = 2
    WAITING_FOR_RESULT = 3
    WAITING_FOR_CANCEL_ACK = 4
    RECALLING = 5
    PREEMPTING = 6
    DONE = 7
    LOST = 8
    to_string = classmethod(get_name_of_constant)


class TerminalState:
    """Final status of a goal."""

    RECALLED = GoalStatus.RECALLED
    REJECTED = GoalStatus.REJECTED
    PREEMPTED = GoalStatus.PREEMPTED
    ABORTED = GoalStatus.ABORTED
    SUCCEEDED = GoalStatus.SUCCEEDED
    LOST = GoalStatus.LOST
    to_string = classmethod(get_name_of_constant)


GoalStatus.to_string = classmethod(get_name_of_constant)

_LETTERS = {
    "P": CommState.PENDING,
    "A": CommState.ACTIVE,
    "R": CommState.RECALLING,
    "E": CommState.PREEMPTING,
    "W": CommState.WAITING_FOR_RESULT,
}
_STATUSES = (
    GoalStatus.PENDING,
    GoalStatus.ACTIVE,
    GoalStatus.REJECTED,
    GoalStatus.RECALLING,
    GoalStatus.RECALLED,
    GoalStatus.PREEMPTING,
    GoalStatus.PREEMPTED,
    GoalStatus.SUCCEEDED,
    GoalStatus.ABORTED,
)
# A column for each of `_STATUSES`: the states passed through; "-": no change, "!": not allowed.
_TABLE = {
    CommState.WAITING_FOR_GOAL_ACK: "P  A  PW PR PW AE AEW AW AW",
    CommState.PENDING: "-  A  W  R  RW AE AEW AW AW",
    CommState.ACTIVE: "!  -  !  !  !  E  EW  W  W",
    CommState.WAITING_FOR_RESULT: "!  -  -  !  -  !  -  -  -",
    CommState.WAITING_FOR_CANCEL_ACK: "-  -  W  R  RW E  EW  EW EW",
    CommState.RECALLING: "!  !  W  -  W  E  EW  EW EW",
    CommState.PREEMPTING: "!  !  !  !  !  -  W  W  W",
    CommState.DONE: "!  !  -  !  -  !  -  -  -",
}
_TRANSITIONS = {state: dict(zip(_STATUSES, cells.split(), strict=True)) for state, cells in _TABLE.items()}


def next_states(state: int, status: int) -> list[int] | None:
    """States that a goal passes through when the server reports `status`; None if the protocol does not allow it.

    Raises:
        KeyError: no such status.
    """
    cell = _TRANSITIONS[state][status]
    if cell == "!":
        return None
    return [] if cell == "-" else [_LETTERS[letter] for letter in cell]

"""What the commanders raise."""


class MoveItCommanderException(Exception):
    """A target or setting that does not fit, or a group that is not there."""

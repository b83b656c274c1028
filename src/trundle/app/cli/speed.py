"""`--speed` of commands that simulate."""

import argparse


def read_speed(text: str) -> float | None:
    """Parse a real-time factor; None for 'max'."""
    if text == "max":
        return None
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is neither a factor, such as 0.5, nor max")
    return value

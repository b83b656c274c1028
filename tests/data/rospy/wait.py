"""Waiting for conditions, for the programs of this folder."""

import time

PATIENCE_S = 60.0


def until(condition):
    """Wait until a condition holds; True, or False after a long time."""
    end = time.time() + PATIENCE_S
    while not condition():
        if time.time() > end:
            print("waited in vain")
            return False
        time.sleep(0.005)
    return True


def said(function, *arguments, **keywords):
    """What a call raises, as text."""
    try:
        return function(*arguments, **keywords)
    except BaseException as error:
        return f"{type(error).__module__.partition('.')[0]}.{type(error).__name__}: {error}"

"""Waiting for a master, as programs with a window do."""

import math
import sys
import time

_POLL_S = 1.0


def wait_for_master(program: str, timeout_s: float = math.inf) -> None:
    """Return when a master answers at ROS_MASTER_URI, or after a time; a line says that it is waited for."""
    from trundle.ros import MasterProxy, MasterUnreachableError, master_uri_from_env

    has_said = False
    due = time.monotonic() + timeout_s
    while time.monotonic() < due:
        try:
            MasterProxy(caller_id=f"/{program}").call("getPid")
            return
        except MasterUnreachableError:
            if not has_said:
                uri = master_uri_from_env()
                print(f"{program}: Could not contact ROS master at [{uri}], retrying...", file=sys.stderr, flush=True)
            has_said = True
            time.sleep(_POLL_S)

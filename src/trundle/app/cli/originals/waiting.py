"""Wait for a master, as in programs with a window."""

import math
import sys
import time

_POLL_S = 1.0


def wait_for_master(program: str, timeout_s: float = math.inf) -> None:
    """Wait until a master answers at ROS_MASTER_URI, or until the timeout; print a line while waiting."""
    from trundle.ros import MasterProxy, MasterUnreachableError, master_uri_from_env

    is_reported = False
    deadline_s = time.monotonic() + timeout_s
    while time.monotonic() < deadline_s:
        try:
            MasterProxy(caller_id=f"/{program}").call("getPid")
            return
        except MasterUnreachableError:
            if not is_reported:
                uri = master_uri_from_env()
                print(f"{program}: Could not contact ROS master at [{uri}], retrying...", file=sys.stderr, flush=True)
            is_reported = True
            time.sleep(_POLL_S)

"""The GPU that steps worlds, if there is one."""

import ctypes
import sys
from importlib.util import find_spec

INSTALL = "pip install 'trundle[gpu]' && pip install --no-deps mujoco-warp"
"""MuJoCo on Warp requires the full `mujoco`, which has the files of mujoco-core: install it without dependencies."""
_DRIVER = "nvcuda.dll" if sys.platform == "win32" else "libcuda.so.1"


class NoGpuError(Exception):
    """No GPU for physics; the message says why, and what to do."""


def find_gpu() -> str:
    """Return Warp's name of the first GPU.

    Raises:
        NoGpuError: no package, no driver, or no GPU.
    """
    missing = [name for name in ("warp", "mujoco_warp") if find_spec(name) is None]
    if missing:
        raise NoGpuError(f"{' and '.join(missing)} not installed: {INSTALL}")
    try:
        ctypes.CDLL(_DRIVER)
    except OSError:
        raise NoGpuError("this machine has no driver of an NVIDIA GPU") from None
    import warp

    warp.config.log_level = warp.LOG_WARNING
    if not warp.is_cuda_available():
        raise NoGpuError("this machine has no NVIDIA GPU that Warp can use")
    return str(warp.get_cuda_devices()[0])

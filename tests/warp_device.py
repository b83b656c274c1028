"""Device of Warp's tests: a GPU if there is one."""

from trundle.sim.physics import NoGpuError, find_gpu


def warp_device() -> str:
    """Return Warp's name of the GPU, or of its CPU device with the same kernels."""
    try:
        return find_gpu()
    except NoGpuError:
        return "cpu"

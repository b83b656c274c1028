"""Where tests of Warp run: on a GPU where there is one."""

from trundle.sim.physics import NoGpuError, find_gpu


def warp_device() -> str:
    """Return Warp's name of the GPU, or of its CPU device, which runs the same kernels."""
    try:
        return find_gpu()
    except NoGpuError:
        return "cpu"

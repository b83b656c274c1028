"""Shortages of a process: open files, memory, threads."""

import errno
import os

try:
    import resource  # imported here, not when needed: importing needs a file descriptor
except ImportError:  # Windows has no `resource`
    resource = None

_NO_MEMORY = ("failed to map segment", "annot allocate memory")
"""Parts of error messages of the dynamic linker and libraries."""
_MIB = 1 << 20


def shortage(error: BaseException | None) -> str | None:
    """Return a sentence on the exhausted resource, its limit and the remedy; None for another error."""
    number = error.errno if isinstance(error, OSError) else None
    if number == errno.EMFILE:
        limit = _limit("RLIMIT_NOFILE")
        return f"this process has as many files open as it may ({limit}; ulimit -n): close some, or raise the limit"
    if number == errno.ENFILE:
        return "all programs together have as many files open as the system allows (fs.file-max): end some, or raise it"
    if isinstance(error, MemoryError) or number == errno.ENOMEM or _is(error, ImportError, *_NO_MEMORY):
        limit = _limit("RLIMIT_AS", _MIB)
        return f"no memory is left (limit of this process [MiB]: {limit}; ulimit -v): end others, or raise the limit"
    if number == errno.ENOBUFS:
        return "the system has no memory left for sockets: end other programs"
    if _is(error, BlockingIOError, os.strerror(errno.EAGAIN)) or _is(error, RuntimeError, "can't start new thread"):
        processes, memory = _limit("RLIMIT_NPROC"), _limit("RLIMIT_AS", _MIB)
        limits = f"limits: {processes} of them, ulimit -u; memory [MiB]: {memory}, ulimit -v"
        return f"no further thread or process can be started ({limits}): end some, or raise the limit"
    return None


def too_few_files(needed: int) -> str | None:
    """Return a sentence if this process may not open as many files as needed; None if it may."""
    limit = _limit("RLIMIT_NOFILE")
    if limit == "none" or int(limit) >= needed:
        return None
    return f"{needed} open files are needed, and this process may have {limit} (ulimit -n): raise the limit"


def _is(error: BaseException | None, kind: type[Exception], *parts: str) -> bool:
    return isinstance(error, kind) and any(part in str(error) for part in parts)


def _limit(name: str, unit: int = 1) -> str:
    """Return a limit of this process, in units; 'none' if it is unlimited."""
    if resource is None:
        return "none"
    soft, _ = resource.getrlimit(getattr(resource, name))
    return "none" if soft == resource.RLIM_INFINITY else str(soft // unit)

"""Entry point of `trundle` and `python -m trundle`."""

import sys


def main() -> int:
    """Run the command; Ctrl-C before its start or after its end exits silently.

    SIGINT is handled even if the parent ignores it, as a script does for `trundle … &`: `kill -INT $!` ends the
    command, like ROS 1's commands, and the command's child processes.
    """
    try:
        import signal

        before = signal.signal(signal.SIGINT, signal.SIG_DFL)
        if hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])  # blocked by cpp/launcher/launcher.cc
    except KeyboardInterrupt:
        return 130
    from trundle.app.cli import main as command
    from trundle.base.interrupts import interrupt, keep_interrupts

    keep_interrupts()
    signal.signal(signal.SIGINT, interrupt if before in (signal.default_int_handler, signal.SIG_IGN) else before)
    code = command()
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # during Python's shutdown no handler runs
    return code


if __name__ == "__main__":
    sys.exit(main())

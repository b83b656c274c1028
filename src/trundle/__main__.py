"""`trundle` and `python -m trundle`: the way in."""

import sys


def main() -> int:
    """Run the command; Ctrl-C before it could begin ends the process without a word."""
    try:
        import signal

        before = signal.signal(signal.SIGINT, signal.SIG_DFL)
        if hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])  # cpp/start.cc held it back
    except KeyboardInterrupt:
        return 130
    from trundle.cli import main as command

    signal.signal(signal.SIGINT, before)
    return command()


if __name__ == "__main__":
    sys.exit(main())

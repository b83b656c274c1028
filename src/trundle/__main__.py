"""`trundle` and `python -m trundle`: the way in."""

import sys


def main() -> int:
    """Run the command; Ctrl-C before it could begin, and after it, ends the process without a word."""
    try:
        import signal

        before = signal.signal(signal.SIGINT, signal.SIG_DFL)
        if hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])  # cpp/start.cc held it back
    except KeyboardInterrupt:
        return 130
    from trundle.cli import main as command

    signal.signal(signal.SIGINT, before)
    code = command()
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while Python ends there is nobody to answer it
    return code


if __name__ == "__main__":
    sys.exit(main())

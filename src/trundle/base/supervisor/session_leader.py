"""Makes standard input the terminal of its session, then becomes the program of its arguments.

`subprocess` could only do so between fork and exec, where a process with threads must not run Python. Uses only the
standard library, since it runs without Trundle's modules.
"""

import os
import signal
import sys


def _main(words: list[str]) -> None:
    import fcntl
    import termios

    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    for number in (signal.SIGPIPE, signal.SIGXFSZ):  # Python ignores these
        signal.signal(number, signal.SIG_DFL)
    try:
        os.execvp(words[0], words)
    except OSError as error:
        sys.exit(f"{words[0]!r} cannot be run: {error}")


if __name__ == "__main__":
    _main(sys.argv[1:])

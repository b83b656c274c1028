"""Launching of launch files from a program."""

import time
from collections.abc import Sequence
from typing import Any

from .core import Process, RLException


class ROSLaunchParent:
    """Launch files, run by `trundle launch`."""

    def __init__(
        self,
        run_id: str,
        roslaunch_files: Sequence[Any] | None,
        is_core: bool = False,
        port: int | None = None,
        local_only: bool = False,
        process_listeners: Any = None,
        verbose: bool = False,
        force_screen: bool = False,
        force_log: bool = False,
        force_required: bool = False,
        **options: Any,
    ) -> None:
        """Create; see `start`.

        Args:
            run_id: identifier of the run.
            roslaunch_files: paths, or pairs of a path and its arguments ('name:=value').
            is_core: start only a master.
            port: master's port.
            local_only: no effect; nothing is started on other machines.
            process_listeners: no effect.
            verbose: print details.
            force_screen: show the nodes' output.
            force_log: write the nodes' output to files.
            force_required: end when the first node ends.
            options: no effect.
        """
        del local_only, process_listeners, options
        self.run_id = run_id
        self.roslaunch_files = list(roslaunch_files or ())
        self.is_core = is_core
        self.port = port
        flags = {"-v": verbose, "--screen": force_screen, "--log": force_log, "--required": force_required}
        self._flags = [flag for flag, is_set in flags.items() if is_set]
        self._processes: list[Process] = []

    def start(self, auto_terminate: bool = True) -> None:
        """Start the launch files.

        Raises:
            RLException: there is nothing to start.
        """
        del auto_terminate
        if not self.roslaunch_files and not self.is_core:
            raise RLException("no launch file")
        port = [] if self.port is None else ["-p", str(self.port)]
        if self.is_core:
            self._processes.append(Process("core", ["core", *port]))
        for file in self.roslaunch_files:
            path, arguments = (file, []) if isinstance(file, str) else file
            words = ["launch", *self._flags, *port, path, *arguments]
            self._processes.append(Process(str(path), words))

    def spin_once(self) -> None:
        """Wait for a short time."""
        time.sleep(0.1)

    def spin(self) -> None:
        """Wait until all launch files have ended, or Ctrl-C."""
        try:
            for process in self._processes:
                process.wait()
        except KeyboardInterrupt:
            self.shutdown()

    def shutdown(self) -> None:
        """Stop the launch files."""
        for process in reversed(self._processes):
            process.stop()
        self._processes.clear()

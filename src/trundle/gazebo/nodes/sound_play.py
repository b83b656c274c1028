"""sound_play/soundplay_node.py: speaks texts and plays files with installed programs."""

import asyncio
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trundle.ros import ActionResult, ActionServer, Node

from .host import NodeHost

_FILE, _SAY, _ALL = -2, -3, -1
_STOP, _START = 0, 2
_SOUNDS = {1: "backing up", 2: "needs unplugging", 3: "needs plugging", 4: "needs unplugging!", 5: "needs plugging!"}
_SPEAKERS = (
    ("espeak-ng", "--stdin", "-a", "{volume200}"),
    ("espeak", "--stdin", "-a", "{volume200}"),
    ("say", "-f", "-"),
)
"""Programs that speak their standard input."""
_PLAYERS = (
    ("paplay", "--volume={volume65536}", "{file}"),
    ("pw-play", "{file}"),
    ("afplay", "-v", "{volume}", "{file}"),
    ("ffplay", "-nodisp", "-autoexit", "-loglevel", "error", "{file}"),
    ("aplay", "-q", "{file}"),
)
_MAX_TEXT = 10_000


@dataclass(frozen=True, slots=True)
class _Sound:
    """Command line that plays a request."""

    command: tuple[str, ...]
    text: str
    """Standard input of the program."""
    repeats: bool


class SoundPlay:
    """Plays the newest request of `robotsound` or the action `sound_play` (sound_play/SoundRequest).

    espeak or macOS' say speaks texts; paplay, pw-play, afplay, ffplay or aplay plays files; without these, the text is
    logged. The original's five sounds are spoken.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._node = node
        self._path = {**os.environ, **host.env}.get("PATH", os.defpath)
        self._task: asyncio.Task[None] | None = None

    async def run(self) -> int:
        """Play until cancelled."""
        node = self._node
        node.subscribe("robotsound", "sound_play/SoundRequest", self._begin, queue_size=10)
        ActionServer(node, "sound_play", "sound_play/SoundRequest", self._on_goal)
        try:
            await node.closed.wait()
        finally:
            if self._task is not None:
                self._task.cancel()
                await asyncio.wait([self._task])
        return 0

    def _begin(self, request: Any) -> "asyncio.Task[None]":
        """Stop the current sound, and play a request."""
        if self._task is not None:
            self._task.cancel()
        self._task = asyncio.get_running_loop().create_task(self._play(request))
        return self._task

    async def _on_goal(self, goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        task = self._begin(goal.sound_request)
        await asyncio.wait([task])
        result = {"playing": False, "stamp": self._node.clock.now_ns()}
        return ActionResult(status="preempted" if task.cancelled() else "succeeded", result=result)

    async def _play(self, request: Any) -> None:
        if request.command == _STOP or request.sound == _ALL:
            return
        sound = self._sound(request)
        while sound is not None and await self._run(sound) and sound.repeats:
            pass

    def _sound(self, request: Any) -> _Sound | None:
        """Find the program for a request; if none is installed, log this and return None."""
        volume = min(max(float(request.volume), 0.0), 1.0) if request.volume > 0.0 else 1.0
        is_file = request.sound == _FILE
        text = str(request.arg)[:_MAX_TEXT] if request.sound == _SAY else _SOUNDS.get(request.sound, "")
        path = Path(str(request.arg)).expanduser().absolute()
        if is_file and not path.is_file():
            self._node.log.error(f"no sound file {path}")
            return None
        values = {"file": str(path), "volume": f"{volume:g}"}
        values |= {"volume200": str(round(100 * volume)), "volume65536": str(round(65536 * volume))}
        for program, *arguments in _PLAYERS if is_file else _SPEAKERS:
            if (program_path := shutil.which(program, path=self._path)) is not None:
                return _Sound(
                    (program_path, *(argument.format_map(values) for argument in arguments)),
                    text,
                    repeats=request.command == _START,
                )
        action = f"plays {path}" if is_file else f"says: {text}"
        missing = ", ".join(program for program, *_ in (_PLAYERS if is_file else _SPEAKERS))
        self._node.log.info(f"{action} (silently: none of {missing} is installed)")
        return None

    async def _run(self, sound: _Sound) -> bool:
        """Play to the end; return False on failure."""
        with tempfile.TemporaryFile() as text, tempfile.TemporaryFile() as errors:
            text.write(sound.text.encode())
            text.seek(0)
            process = await asyncio.create_subprocess_exec(
                *sound.command, stdin=text, stdout=subprocess.DEVNULL, stderr=errors
            )
            try:
                code = await process.wait()
            finally:
                if process.returncode is None:
                    process.terminate()
                    await process.wait()
            if code:
                errors.seek(0)
                line = errors.read(_MAX_TEXT).decode(errors="replace").strip()
                self._node.log.error(f"{sound.command[0]}: {line or code}")
        return code == 0

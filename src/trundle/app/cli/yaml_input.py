"""YAML from the command line, a file or standard input."""

import sys
from collections.abc import Iterator
from pathlib import Path

from trundle.base.diagnostics import UsageError


def yaml_value(text: str) -> object:
    """Parse a YAML value from the command line."""
    import yaml

    from trundle.base.yaml_loader import load_yaml

    try:
        return load_yaml(text)
    except yaml.YAMLError as error:
        raise UsageError(f"Argument error: {error}") from None


def yaml_file(path: str) -> Iterator[object]:
    """Yield the non-empty documents of a file."""
    import yaml

    from trundle.base.yaml_loader import BoundedLoader

    try:
        text = Path(path).read_text(encoding="utf-8")
        yield from (document for document in yaml.load_all(text, BoundedLoader) if document is not None)
    except OSError as error:
        raise UsageError(f"file cannot be read: {path}: {error.strerror}") from None
    except yaml.YAMLError as error:
        raise UsageError(f"invalid YAML in file {path}: {error}") from None


def piped_documents() -> Iterator[object]:
    """Yield documents from standard input, each as soon as the `---` after it arrives."""
    lines: list[str] = []
    for line in sys.stdin:
        if line.strip() != "---":
            lines.append(line)
            continue
        document, lines = yaml_value("".join(lines)), []
        if document is not None:
            yield document

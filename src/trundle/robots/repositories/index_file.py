"""Reader of users' index files: a distribution.yaml, or an index-v4.yaml that names several (REP 143, REP 153)."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast
from urllib.error import URLError
from urllib.parse import urljoin, urlsplit
from urllib.request import urlopen

import yaml

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.files import read_text
from trundle.base.yaml_loader import load_yaml, one_line

from .distribution import read_distribution
from .entry import ROSDISTROS, Entry
from .index import Index

_MAX_BYTES = 8 * 1024 * 1024
_TIMEOUT_S = 60.0
_WEB = ("http", "https")


def read_index(location: str, distro: str) -> Index:
    """Read an index.

    Args:
        location: URL or path.
        distro: distribution of a distribution.yaml, which does not name it.

    Raises:
        DescriptionError: the index cannot be read.
    """
    if "://" not in location:
        location = os.path.abspath(os.path.expanduser(location))
    document = _load(location)
    if not isinstance(document, dict) or not {"repositories", "distributions"} & set(document):
        raise DescriptionError(Source(location), "no index: expected 'repositories' or 'distributions' (REP 143)")
    if "repositories" in document:
        return Index(read_distribution(document, distro))
    return Index(_distributions(cast("dict[str, Any]", document), location))


def _distributions(document: dict[str, Any], location: str) -> Iterator[Entry]:
    named: Any = document["distributions"]
    for distro in ROSDISTROS:
        facts = named.get(distro) if isinstance(named, dict) else None
        files = facts.get("distribution") if isinstance(facts, dict) else None
        for file in files if isinstance(files, list) else []:
            yield from read_distribution(_load(_resolve(location, str(file))), distro)


def _resolve(location: str, file: str) -> str:
    """Return the location of a file named in an index; an index from the web may only name files from the web."""
    if urlsplit(location).scheme in _WEB:
        return urljoin(location, file)
    folder = Path(location).parent
    path = Path(os.path.normpath(folder / file))
    if not path.is_relative_to(folder):
        raise DescriptionError(Source(location), f"distribution {file!r} is outside the index's folder")
    return str(path)


def _load(location: str) -> object:
    at = Source(location)
    try:
        text = _download(location) if "://" in location else read_text(location, max_bytes=_MAX_BYTES)
        return load_yaml(text)
    except yaml.YAMLError as error:
        raise DescriptionError(at, f"not YAML: {one_line(error)}") from None
    except URLError as error:
        raise DescriptionError(at, f"not fetched: {error.reason}") from None
    except OSError as error:
        raise DescriptionError(at, str(error.strerror or error)) from None


def _download(url: str) -> str:
    if urlsplit(url).scheme not in _WEB:
        raise DescriptionError(Source(url), "an index is fetched from http:// or https://, or read from a file")
    with urlopen(url, timeout=_TIMEOUT_S) as answer:
        data = answer.read(_MAX_BYTES + 1)
    if len(data) > _MAX_BYTES:
        raise DescriptionError(Source(url), f"larger than {_MAX_BYTES} bytes")
    return data.decode(errors="replace")

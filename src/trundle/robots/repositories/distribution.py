"""Reader of lists of repositories: distribution.yaml (REP 143), .rosinstall and .repos."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import yaml

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.yaml_loader import load_yaml, one_line

from .address import check_branch, check_folder, https_address
from .entry import Entry


class ListedRepository(NamedTuple):
    """Repository of a workspace's list."""

    folder: str
    """Path below the workspace's src."""
    url: str
    branch: str
    """'': the default branch."""


def read_distribution(document: Any, distro: str) -> Iterator[Entry]:
    """Yield the git repositories of a distribution.yaml; others, and those with an invalid address, are left out.

    Args:
        document: parsed YAML.
        distro: name of the distribution.
    """
    for name, repository in _mapping(_mapping(document).get("repositories")).items():
        fields = _mapping(repository)
        source = _mapping(fields.get("source") or fields.get("doc"))
        packages = _mapping(fields.get("release")).get("packages") or [name]
        if source.get("type") != "git":
            continue
        try:
            url, branch = https_address(str(source.get("url"))), check_branch(str(source.get("version") or ""))
        except ValueError:
            continue
        words = tuple(
            str(package) for package in packages if str(package).isprintable() and not set(str(package)) & set(" \t")
        )
        yield Entry(url, {distro: branch}, words)


def read_repository_list(text: str, file: str) -> list[ListedRepository]:
    """Read a .rosinstall or .repos file.

    Args:
        text: contents of the file.
        file: file name in errors.

    Raises:
        DescriptionError: another format, or an address, branch or folder that is refused.
    """
    at = Source(file)
    try:
        document = load_yaml(text)
    except yaml.YAMLError as error:
        raise DescriptionError(at, f"not YAML: {one_line(error)}") from None
    if isinstance(document, Mapping) and "repositories" in document:
        rows = [(name, _mapping(row)) for name, row in _mapping(document["repositories"]).items()]
        repositories = [(row.get("type"), name, row.get("url"), row.get("version")) for name, row in rows]
    elif isinstance(document, list):
        pairs = [(kind, _mapping(row)) for item in document for kind, row in _mapping(item).items()]
        repositories = [(kind, row.get("local-name"), row.get("uri"), row.get("version")) for kind, row in pairs]
    else:
        raise DescriptionError(at, "a list of repositories begins with 'repositories:' (vcs) or '- git:' (rosinstall)")
    listed: list[ListedRepository] = []
    for kind, folder, url, version in repositories:
        if kind != "git":
            raise DescriptionError(at, f"{folder}: only git repositories can be fetched, not {kind!r}")
        try:
            listed.append(
                ListedRepository(check_folder(str(folder)), https_address(str(url)), check_branch(str(version or "")))
            )
        except ValueError as error:
            raise DescriptionError(at, f"{folder}: {error}") from None
    return listed


def write_rosinstall(listed: Iterable[ListedRepository]) -> str:
    """Return the text of a .rosinstall file."""
    rows = [
        {"git": {"local-name": folder, "uri": url} | ({"version": branch} if branch else {})}
        for folder, url, branch in listed
    ]
    return yaml.safe_dump(rows, sort_keys=False)


def _mapping(value: Any) -> Mapping[Any, Any]:
    return value if isinstance(value, Mapping) else {}

"""Validation of repository addresses, branches and folders from possibly hostile files."""

import re

_SCHEMES = ("https", "http", "git")
"""Protocols of git that run no program; file:// would copy local folders, and ssh and ext run programs."""
_SCP = re.compile(r"(?:ssh://)?git@([\w.-]+)[:/](?![/-])(.+)")
_ADDRESS = re.compile(r"(\w+)://(?:[\w.-]+@)?([\w][\w.-]*)(:\d+)?/[\w.~/+%-]+")
_BRANCH = re.compile(r"\w[\w./+#-]*")


def https_address(url: str) -> str:
    """Return the address of a repository; `git@host:path`, which needs a key, becomes https://host/path.

    Raises:
        ValueError: git would do more than fetch from another machine.
    """
    if scp := _SCP.fullmatch(url):
        url = f"https://{scp[1]}/{scp[2]}"
    match = _ADDRESS.fullmatch(url)
    if match is None or match[1] not in _SCHEMES or "/../" in f"{url}/":
        raise ValueError(f"address {url!r} is refused; expected {', '.join(f'{scheme}://…' for scheme in _SCHEMES)}")
    return url


def check_branch(name: str) -> str:
    """Return the name of a branch, tag or commit; '' is the default branch.

    Raises:
        ValueError: not a valid name, such as an option of git.
    """
    if name and (not _BRANCH.fullmatch(name) or ".." in name):
        raise ValueError(f"version {name!r} is refused; expected a branch, tag or commit")
    return name


def check_folder(path: str) -> str:
    """Return a relative path that stays below its folder.

    Raises:
        ValueError: the path is absolute, hidden, or leads outside.
    """
    parts = path.split("/")
    if not path.isprintable() or "\\" in path or any(not part or part[0] in ".-~" or ":" in part for part in parts):
        raise ValueError(f"folder {path!r} is refused; expected a path below the workspace's src")
    return path

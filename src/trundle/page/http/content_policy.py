"""Content security policy of the page's responses."""

from trundle.base.http.access import Access, PageRequest

_COMMON = "object-src 'none'; base-uri 'none'; form-action 'none'"
_SOCKET_WORKERS = ("drive_worker", "socket_worker")


def response_fields(access: Access, request: PageRequest, *, path: str) -> dict[str, str]:
    """Return the header fields of a response.

    The document runs only the client's own scripts; `blob:` is for textures of glTF files. Workers decode untrusted
    messages and must not open connections, except for those that hold a socket and decode none.
    """
    fields = access.response_fields(request)
    directives = fields["Content-Security-Policy"].split("; ")
    framers = next(directive for directive in directives if directive.startswith("frame-ancestors"))
    connect = next(directive for directive in directives if directive.startswith("connect-src"))
    if is_worker(path):
        allowed = connect if _name(path).startswith(_SOCKET_WORKERS) else "connect-src 'none'"
        policy = f"default-src 'none'; script-src 'self'; {allowed}; {framers}; {_COMMON}"
    else:
        policy = (
            "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
            f"media-src 'self' blob:; worker-src 'self'; {connect}; {framers}; {_COMMON}"
        )
    return fields | {"Content-Security-Policy": policy}


def is_worker(path: str) -> bool:
    """True for the script of a worker: Vite keeps `worker` in its file name."""
    name = _name(path)
    return name.endswith(".js") and "worker" in name


def _name(path: str) -> str:
    return path.rpartition("/")[2]

"""Content security policy of the page's responses."""

from trundle.base.http.access import Access, PageRequest

_COMMON = "object-src 'none'; base-uri 'none'; form-action 'none'"


def response_fields(access: Access, request: PageRequest, *, path: str) -> dict[str, str]:
    """Return the header fields of a response.

    The document runs the client's own scripts and nothing else; `blob:` is for textures of glTF files. Workers decode
    messages of others and may open no connection.
    """
    fields = access.response_fields(request)
    given = fields["Content-Security-Policy"]
    framers = next(part for part in given.split("; ") if part.startswith("frame-ancestors"))
    connect = next(part for part in given.split("; ") if part.startswith("connect-src"))
    if is_worker(path):
        policy = f"default-src 'none'; script-src 'self'; connect-src 'none'; {framers}; {_COMMON}"
    else:
        policy = (
            "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
            f"media-src 'self' blob:; worker-src 'self'; {connect}; {framers}; {_COMMON}"
        )
    return fields | {"Content-Security-Policy": policy}


def is_worker(path: str) -> bool:
    """True for the script of a worker: Vite keeps `worker` in its name."""
    name = path.rpartition("/")[2]
    return name.endswith(".js") and "worker" in name

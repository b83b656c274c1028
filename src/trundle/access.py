"""Access control of the page: which requests are served, and the header fields of responses.

Any web page that a user visits can have the browser send requests to loopback, and its domain can resolve to it (DNS
rebinding). It cannot choose `Origin` and `Host`, or guess the session's token.
"""

import secrets
import socket
from dataclasses import dataclass, field
from urllib.parse import parse_qs

from .page_address import AUTHORITY, NONE_ALLOWED, AllowedNames, is_address, is_loopback


@dataclass(frozen=True, slots=True, kw_only=True)
class AccessWords:
    """Texts of refusals: the server, and how to open it."""

    server: str = "this page"
    token: str = "open the address that trundle printed, with what follows '?token='"
    host: str = "start trundle with --allow-host NAME"
    origin: str = "start trundle with --allow-origin ORIGIN"


_PAGE = AccessWords()


@dataclass(frozen=True, slots=True, kw_only=True)
class PageRequest:
    """Fields of an HTTP request or WebSocket upgrade that decide access."""

    target: str
    """Path and query."""
    host: str | None = None
    origin: str | None = None
    cookie: str = ""
    is_embedded: bool = False
    """True if another site's page shows the answer as a part of its own, as an image: it sends no Origin."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Access:
    """Access rules of one server."""

    host: str
    """Host name or address of the socket."""
    port: int
    allowed: AllowedNames = NONE_ALLOWED
    needs_token: bool = False
    """True if the token is required; always so off loopback."""
    token: str = field(default_factory=lambda: secrets.token_urlsafe(16))
    view_token: str | None = None
    """Token of requests that may look and change nothing; None: there is none."""
    serves_local_pages: bool = False
    """True: pages of every port of this machine are served, as for a server without a page of its own."""
    serves_null_origin: bool = False
    """True: pages of files are served, whose origin is 'null', as is that of any page's sandboxed frame."""
    is_open: bool = False
    """True: every request is served, as by ROS' own servers."""
    words: AccessWords = _PAGE

    def url(self, address: str, port: int) -> str:
        """Return the URL, with the token if required."""
        return self._url(address, port, self.token if self.asks_token else None)

    def view_url(self, address: str, port: int) -> str:
        """Return the URL of a page that may look and change nothing."""
        assert self.view_token is not None, "there is a token for looking"
        return self._url(address, port, self.view_token)

    def refusal(self, request: PageRequest) -> str | None:
        """Return the reason for refusing a request, as a sentence; None: it is served."""
        return None if self._has_token(request, self.view_token) else self._control_refusal(request)

    def is_view_only(self, request: PageRequest) -> bool:
        """True if a request that is served may look and change nothing: its URL says so, or it has no other right."""
        return _is_in_query(request, self.view_token) or self._control_refusal(request) is not None

    def _control_refusal(self, request: PageRequest) -> str | None:
        """Return the reason for refusing a request that may change things."""
        words = self.words
        if self.is_open or self._has_token(request, self.token):
            return None
        if self.asks_token:
            return f"{words.server} asks for its token: {words.token}"
        if request.origin is not None and _plain(request.origin) in map(_plain, self.allowed.origins):
            return None
        if not self._allows_host(request.host):
            return (
                f"{words.server} is not served as {(request.host or '')[:100]!r}; open it at localhost, or {words.host}"
            )
        if not _is_own(request) and not self._serves_origin(request.origin or ""):
            pages = f"pages of {request.origin[:100]!r}" if request.origin else "other sites' pages"
            return f"{words.server} does not answer {pages}; {words.origin} to let them in"
        return None

    def answer_fields(self, request: PageRequest) -> dict[str, str]:
        """Return the header fields of a response.

        The cookie carries the token on to the page's own requests; the policy keeps other pages from framing this one,
        and scripts in this one from contacting other servers.
        """
        framers = " ".join(("'self'", *self.allowed.origins))
        here = f" ws://{request.host} wss://{request.host}" if _name(request.host) else ""
        fields = {
            "Content-Security-Policy": (
                f"connect-src 'self' data: blob:{here}; "
                f"frame-ancestors {framers}; "
                "object-src 'none'; base-uri 'none'; form-action 'none'"
            ),
            "Cross-Origin-Resource-Policy": "same-origin",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
        }
        for token in (self.token, self.view_token):
            if token is not None and _is_in_query(request, token):
                fields["Set-Cookie"] = f"{self._cookie(token)}={token}; Path=/; HttpOnly; SameSite=Strict"
        return fields

    @property
    def asks_token(self) -> bool:
        """True if requests need a token."""
        return self.needs_token or not is_loopback(self.host)

    def _url(self, address: str, port: int, token: str | None) -> str:
        query = "" if token is None else f"/?token={token}"
        return f"http://{f'[{address}]' if ':' in address else address}:{port}{query}"

    def _cookie(self, token: str) -> str:
        """Cookie name; the port distinguishes pages of one host, and each kind of token has a cookie of its own."""
        return f"trundle-{self.port}{'-view' if token == self.view_token else ''}"

    def _serves_origin(self, origin: str) -> bool:
        """True for local pages and files, where they are served."""
        if origin == "null":
            return self.serves_null_origin
        scheme, separator, authority = origin.lower().partition("://")
        is_web = bool(separator) and scheme in ("http", "https")
        return self.serves_local_pages and is_web and is_loopback(_name(authority))

    def _has_token(self, request: PageRequest, token: str | None) -> bool:
        """True if a request has a token in its URL, or one of this server's own page as a cookie."""
        if token is None:
            return False
        kept = [pair.strip().partition("=") for pair in request.cookie.split(";")]
        is_kept = any(name == self._cookie(token) and _is_same(value, token) for name, _, value in kept)
        return _is_in_query(request, token) or (is_kept and _is_own(request))

    def _allows_host(self, host: str | None) -> bool:
        name = _name(host)
        names = ("localhost", socket.gethostname(), self.host, *self.allowed.hosts)
        return bool(name) and (is_address(name) or name in map(_name, names))


def _is_in_query(request: PageRequest, token: str | None) -> bool:
    return token is not None and _is_same(parse_qs(request.target.partition("?")[2]).get("token", [""])[-1], token)


def _is_same(text: str, token: str) -> bool:
    return secrets.compare_digest(text.encode("utf-8", "surrogateescape"), token.encode())


def _is_own(request: PageRequest) -> bool:
    """True if the request comes from no page or from one of this server."""
    if request.origin is None:
        return not request.is_embedded
    host = (request.host or "").lower()
    return request.origin.lower() in (f"http://{host}", f"https://{host}")


def _name(host: str | None) -> str:
    """Return the name or address in a `Host` field; empty if invalid."""
    found = AUTHORITY.fullmatch((host or "").lower())
    return "" if found is None else found[1].strip("[]").rstrip(".")


def _plain(origin: str) -> str:
    return origin.lower().rstrip("/")

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
    serves_local_pages: bool = False
    """True: pages of every port of this machine are served, as for a server without a page of its own."""
    serves_null_origin: bool = False
    """True: pages of files are served, whose origin is 'null', as is that of any page's sandboxed frame."""
    is_open: bool = False
    """True: every request is served, as by ROS' own servers."""
    words: AccessWords = _PAGE

    def url(self, address: str, port: int) -> str:
        """Return the URL, with the token if required."""
        query = f"/?token={self.token}" if self._is_closed else ""
        return f"http://{f'[{address}]' if ':' in address else address}:{port}{query}"

    def refusal(self, request: PageRequest) -> str | None:
        """Return the reason for refusing a request, as a sentence; None: it is served."""
        words = self.words
        if self.is_open or self._has_token_in_query(request):
            return None
        if self._has_token_in_cookie(request) and _is_own(request):
            return None
        if self._is_closed:
            return f"{words.server} asks for its token: {words.token}"
        if request.origin is not None and _plain(request.origin) in map(_plain, self.allowed.origins):
            return None
        if not self._allows_host(request.host):
            return (
                f"{words.server} is not served as {(request.host or '')[:100]!r}; open it at localhost, or {words.host}"
            )
        if not _is_own(request) and not self._serves_origin(request.origin or ""):
            return (
                f"{words.server} does not answer pages of {(request.origin or '')[:100]!r}; "
                f"{words.origin} to let them in"
            )
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
        if self._has_token_in_query(request):
            fields["Set-Cookie"] = f"{self._cookie}={self.token}; Path=/; HttpOnly; SameSite=Strict"
        return fields

    @property
    def _is_closed(self) -> bool:
        return self.needs_token or not is_loopback(self.host)

    @property
    def _cookie(self) -> str:
        """Cookie name; the port distinguishes pages of one host."""
        return f"trundle-{self.port}"

    def _serves_origin(self, origin: str) -> bool:
        """True for local pages and files, where they are served."""
        if origin == "null":
            return self.serves_null_origin
        scheme, separator, authority = origin.lower().partition("://")
        is_web = bool(separator) and scheme in ("http", "https")
        return self.serves_local_pages and is_web and is_loopback(_name(authority))

    def _has_token_in_query(self, request: PageRequest) -> bool:
        return self._matches(parse_qs(request.target.partition("?")[2]).get("token", [""])[-1])

    def _has_token_in_cookie(self, request: PageRequest) -> bool:
        kept = [pair.strip().partition("=") for pair in request.cookie.split(";")]
        return any(name == self._cookie and self._matches(value) for name, _, value in kept)

    def _matches(self, text: str) -> bool:
        return secrets.compare_digest(text.encode(), self.token.encode())

    def _allows_host(self, host: str | None) -> bool:
        name = _name(host)
        names = ("localhost", socket.gethostname(), self.host, *self.allowed.hosts)
        return bool(name) and (is_address(name) or name in map(_name, names))


def _is_own(request: PageRequest) -> bool:
    """True if the request comes from no page or from one of this server."""
    if request.origin is None:
        return True
    host = (request.host or "").lower()
    return request.origin.lower() in (f"http://{host}", f"https://{host}")


def _name(host: str | None) -> str:
    """Return the name or address in a `Host` field; empty if invalid."""
    found = AUTHORITY.fullmatch((host or "").lower())
    return "" if found is None else found[1].strip("[]").rstrip(".")


def _plain(origin: str) -> str:
    return origin.lower().rstrip("/")

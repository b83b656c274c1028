"""Access control of the page: which requests are served, and the header fields of responses.

Every user of the machine reaches loopback, and any web page that a user visits can have the browser send requests
there; its domain can resolve to it (DNS rebinding). Neither knows the session's token, and a web page cannot choose
`Origin` and `Host`.
"""

import re
import secrets
import socket
from dataclasses import dataclass, field
from typing import Literal, NamedTuple
from urllib.parse import parse_qs

from .page_address import AUTHORITY, NONE_ALLOWED, AllowedNames, is_address, is_loopback


@dataclass(frozen=True, slots=True, kw_only=True)
class AccessWords:
    """Texts of refusals: the server, and how to open it."""

    server: str = "this page"
    token: str = "open the link that trundle printed, or that 'trundle page link' prints"
    host: str = "start trundle with --allow-host NAME"
    origin: str = "start trundle with --allow-origin ORIGIN"


_PAGE = AccessWords()
_TOKEN = re.compile(r"(?<=[?&]token=)[\w-]+")
VIEW_ONLY = "view_only"
"""Field of a query: the request looks and changes nothing, whatever its cookies allow."""


class Refusal(NamedTuple):
    """Refusal of a request."""

    text: str
    """The reason, as a sentence."""
    asks_token: bool = False
    """True if the token is what it lacks."""
    is_guess: bool = False
    """True if it came with a wrong token."""


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
    """True if the token is required on loopback, too; off loopback it always is."""
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

    def refusal(self, request: PageRequest) -> Refusal | None:
        """Return the reason for refusing a request; None: it is served."""
        words = self.words
        if self.is_open:
            return None
        if self.asks_token and self._right(request) is None:
            text = f"{words.server} asks for its token: {words.token}"
            return Refusal(text, asks_token=True, is_guess=self._has_wrong_token(request))
        if self._is_let_in(request):
            return None
        if is_loopback(self.host) and not self._allows_host(request.host):
            name = (request.host or "")[:100]
            return Refusal(f"{words.server} is not served as {name!r}; open it at localhost, or {words.host}")
        has_token = self._right_of_query(request) is not None
        if not has_token and not _is_own(request) and not self._serves_origin(request.origin or ""):
            pages = f"pages of {request.origin[:100]!r}" if request.origin else "other sites' pages"
            return Refusal(f"{words.server} does not answer {pages}; {words.origin} to let them in")
        return None

    def is_view_only(self, request: PageRequest) -> bool:
        """True if a request that is served may look and change nothing: its URL says so, or it has no other right."""
        return VIEW_ONLY in _query(request) or self._right(request) == "look"

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
        if (right := self._right_of_query(request)) is not None:
            token = self._tokens[right]
            fields["Set-Cookie"] = f"{self._cookie(right)}={token}; Path=/; HttpOnly; SameSite=Strict"
        return fields

    @property
    def asks_token(self) -> bool:
        """True if requests need a token."""
        return self.needs_token or not is_loopback(self.host)

    def _url(self, address: str, port: int, token: str | None) -> str:
        query = "" if token is None else f"/?token={token}"
        return f"http://{f'[{address}]' if ':' in address else address}:{port}{query}"

    @property
    def _tokens(self) -> "dict[Right, str]":
        tokens: dict[Right, str] = {"control": self.token}
        return tokens if self.view_token is None else {**tokens, "look": self.view_token}

    def _cookie(self, right: "Right") -> str:
        """Cookie name; the port distinguishes pages of one host, and each kind of token has a cookie of its own."""
        return f"trundle-{self.port}{'-view' if right == 'look' else ''}"

    def _right(self, request: PageRequest) -> "Right | None":
        """Return what a request may do by its tokens: by that in its URL, else by the cookies that our pages send."""
        if (right := self._right_of_query(request)) is not None:
            return right
        kept = _cookies(request) if _is_own(request) or self._is_let_in(request) else {}
        return self._right_of({right: kept.get(self._cookie(right), "") for right in self._tokens})

    def _right_of_query(self, request: PageRequest) -> "Right | None":
        given = _query(request).get("token", [""])[-1]
        return self._right_of(dict.fromkeys(self._tokens, given))

    def _right_of(self, given: "dict[Right, str]") -> "Right | None":
        """Return the right whose token was given; all are compared, in constant time."""
        rights: list[Right] = [right for right, token in self._tokens.items() if _is_same(given[right], token)]
        return rights[0] if rights else None

    def _has_wrong_token(self, request: PageRequest) -> bool:
        """True if a refused request brought a token, in its URL or as a cookie."""
        kept = _cookies(request)
        return any(_query(request).get("token", [])) or any(kept.get(self._cookie(right)) for right in self._tokens)

    def _is_let_in(self, request: PageRequest) -> bool:
        """True for pages whose origin is allowed by name."""
        return request.origin is not None and _plain(request.origin) in map(_plain, self.allowed.origins)

    def _serves_origin(self, origin: str) -> bool:
        """True for local pages and files, where they are served."""
        if origin == "null":
            return self.serves_null_origin
        scheme, separator, authority = origin.lower().partition("://")
        is_web = bool(separator) and scheme in ("http", "https")
        return self.serves_local_pages and is_web and is_loopback(_name(authority))

    def _allows_host(self, host: str | None) -> bool:
        name = _name(host)
        names = ("localhost", socket.gethostname(), self.host, *self.allowed.hosts)
        return bool(name) and (is_address(name) or name in map(_name, names))


def without_tokens(text: str) -> str:
    """Return a text for a log: tokens of links in it are replaced by an ellipsis."""
    return _TOKEN.sub("…", text)


def without_query(url: str) -> str:
    """Return the server's part of a link, which opens nothing: `http://127.0.0.1:8080`."""
    return url.partition("?")[0].rstrip("/")


Right = Literal["control", "look"]
"""Right that a token gives."""


def _is_own(request: PageRequest) -> bool:
    """True if the request comes from no page or from one of this server."""
    if request.origin is None:
        return not request.is_embedded
    host = (request.host or "").lower()
    return request.origin.lower() in (f"http://{host}", f"https://{host}")


def _query(request: PageRequest) -> dict[str, list[str]]:
    return parse_qs(request.target.partition("?")[2], keep_blank_values=True)


def _cookies(request: PageRequest) -> dict[str, str]:
    pairs = (pair.strip().partition("=") for pair in request.cookie.split(";"))
    return {name: value for name, _, value in pairs}


def _is_same(text: str, token: str) -> bool:
    return secrets.compare_digest(text.encode("utf-8", "surrogateescape"), token.encode())


def _name(host: str | None) -> str:
    """Return the name or address in a `Host` field; empty if invalid."""
    found = AUTHORITY.fullmatch((host or "").lower())
    return "" if found is None else found[1].strip("[]").rstrip(".")


def _plain(origin: str) -> str:
    return origin.lower().rstrip("/")

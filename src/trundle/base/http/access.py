"""Access control of the page: which requests are served, with which response headers.

Every user of the machine can reach loopback, and any web page that a user visits can make the browser send requests
to it; the page's domain can resolve to loopback (DNS rebinding). Neither has the session's token, and a web page
cannot choose `Origin` and `Host`.
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
"""Query parameter: the request is view-only, whatever its cookies allow."""


class Refusal(NamedTuple):
    """Refusal of a request."""

    text: str
    """The reason, as a sentence."""
    asks_token: bool = False
    """True if a token is missing."""
    is_guess: bool = False
    """True if the request's token is wrong."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PageRequest:
    """Fields of an HTTP request or WebSocket upgrade that decide access."""

    target: str
    """Path and query."""
    host: str | None = None
    origin: str | None = None
    cookie: str = ""
    is_embedded: bool = False
    """True if another site's page embeds the response, for example as an image: such requests have no Origin."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Access:
    """Access rules of one server."""

    host: str
    """Host name or address of the socket."""
    port: int
    allowed: AllowedNames = NONE_ALLOWED
    needs_token: bool = False
    """True if the token is required on loopback too; elsewhere it always is."""
    token: str = field(default_factory=lambda: secrets.token_urlsafe(16))
    view_token: str | None = None
    """Token of view-only requests; None: there is none."""
    serves_local_pages: bool = False
    """True: requests from pages at any port of this machine are served, as by a server without its own page."""
    serves_null_origin: bool = False
    """True: requests from file:// pages are served; their origin is 'null', like any page's sandboxed frame's."""
    is_open: bool = False
    """True: every request is served, as by ROS' own servers."""
    words: AccessWords = _PAGE

    def url(self, address: str, port: int) -> str:
        """Return the URL, with the token if required."""
        return self._url(address, port, self.token if self.asks_token else None)

    def view_url(self, address: str, port: int) -> str:
        """Return the URL of a view-only page."""
        assert self.view_token is not None, "the server has a view-only token"
        return self._url(address, port, self.view_token)

    def refusal(self, request: PageRequest) -> Refusal | None:
        """Return the reason for refusing a request; None: it is served."""
        words = self.words
        if self.is_open:
            return None
        if self.asks_token and self._right(request) is None:
            text = f"{words.server} asks for its token: {words.token}"
            return Refusal(text, asks_token=True, is_guess=self._has_wrong_token(request))
        if self._is_allowed_origin(request):
            return None
        if is_loopback(self.host) and not self._allows_host(request.host):
            name = (request.host or "")[:100]
            return Refusal(f"{words.server} is not served as {name!r}; open it at localhost, or {words.host}")
        has_token = self._right_of_query(request) is not None
        if not has_token and not _is_own(request) and not self._serves_origin(request.origin or ""):
            pages = f"pages of {request.origin[:100]!r}" if request.origin else "other sites' pages"
            return Refusal(f"{words.server} does not answer {pages}; {words.origin} to allow them")
        return None

    def is_view_only(self, request: PageRequest) -> bool:
        """True if a served request is view-only, by its URL or by its token."""
        return VIEW_ONLY in _query(request) or self._right(request) == "view"

    def response_fields(self, request: PageRequest) -> dict[str, str]:
        """Return the headers of a response.

        The cookie passes the token on to the page's own requests; the policy stops other pages from framing this one,
        and scripts of this one from contacting other servers.
        """
        framers = " ".join(("'self'", *self.allowed.origins))
        web_sockets = f" ws://{request.host} wss://{request.host}" if _name(request.host) else ""
        fields = {
            "Content-Security-Policy": (
                f"connect-src 'self' data: blob:{web_sockets}; "
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

    def base_url(self, address: str, port: int) -> str:
        """Return the URL of the server at an address, without a path."""
        return f"http://{f'[{address}]' if ':' in address else address}:{port}"

    def _url(self, address: str, port: int, token: str | None) -> str:
        return f"{self.base_url(address, port)}{'' if token is None else f'/?token={token}'}"

    @property
    def _tokens(self) -> "dict[Right, str]":
        tokens: dict[Right, str] = {"control": self.token}
        return tokens if self.view_token is None else {**tokens, "view": self.view_token}

    def _cookie(self, right: "Right") -> str:
        """Cookie name; the port distinguishes pages of one host, and each right has its own cookie."""
        return f"trundle-{self.port}{'-view' if right == 'view' else ''}"

    def _right(self, request: PageRequest) -> "Right | None":
        """Return the right of a request's token: of its URL, else of the cookies that this server's pages send."""
        if (right := self._right_of_query(request)) is not None:
            return right
        cookies = _cookies(request) if _is_own(request) or self._is_allowed_origin(request) else {}
        return self._right_of({right: cookies.get(self._cookie(right), "") for right in self._tokens})

    def _right_of_query(self, request: PageRequest) -> "Right | None":
        token = _query(request).get("token", [""])[-1]
        return self._right_of(dict.fromkeys(self._tokens, token))

    def _right_of(self, candidates: "dict[Right, str]") -> "Right | None":
        """Return the right whose token matches its candidate; all are compared, in constant time."""
        rights: list[Right] = [right for right, token in self._tokens.items() if _is_same(candidates[right], token)]
        return rights[0] if rights else None

    def _has_wrong_token(self, request: PageRequest) -> bool:
        """True if a refused request has a token, in its URL or as a cookie."""
        cookies = _cookies(request)
        return any(_query(request).get("token", [])) or any(cookies.get(self._cookie(right)) for right in self._tokens)

    def _is_allowed_origin(self, request: PageRequest) -> bool:
        """True for pages with an allowed origin."""
        return request.origin is not None and _plain(request.origin) in map(_plain, self.allowed.origins)

    def _serves_origin(self, origin: str) -> bool:
        """True for local pages and files, if they are served."""
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
    """Return a text for a log, with tokens of links replaced by an ellipsis."""
    return _TOKEN.sub("…", text)


def without_query(url: str) -> str:
    """Return a link without its token: `http://127.0.0.1:8080`."""
    return url.partition("?")[0].rstrip("/")


Right = Literal["control", "view"]
"""Right that a token grants."""


def _is_own(request: PageRequest) -> bool:
    """True if the request comes from this server's page, or from no page."""
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
    match = AUTHORITY.fullmatch((host or "").lower())
    return "" if match is None else match[1].strip("[]").rstrip(".")


def _plain(origin: str) -> str:
    return origin.lower().rstrip("/")

"""Address and access rules of nodes that serve web pages and programs."""

import secrets
import socket
from dataclasses import dataclass

from trundle.base.http.access import Access, AccessWords
from trundle.base.http.page_address import AllowedNames, is_loopback
from trundle.robots.parameters import ParamError, RosParameters

_LOOPBACK = "127.0.0.1"
_EVERYBODY = "*"
_BACKLOG = 128
_MAX_PORT = 65535


@dataclass(frozen=True, slots=True, kw_only=True)
class WebAddress:
    """Parameters of a server: address, port, allowed_origins, allowed_hosts, token.

    The rules are those of the page (docs/decisions/0016).
    """

    host: str
    port: int
    allowed: AllowedNames
    is_open: bool
    """True: `allowed_origins` is "*"; every request is served, as by the original."""
    token: str
    """As the parameter sets it, else a random one."""
    has_own_token: bool = False
    """True if the parameter sets the token; it is then required on loopback, too."""
    serves_null_origin: bool = False

    @property
    def is_public(self) -> bool:
        """True if other machines reach it."""
        return not is_loopback(self.host)

    def access(self, server: str, port: int) -> Access:
        """Access rules of the server at its actual port."""
        return Access(
            host=self.host,
            port=port,
            allowed=self.allowed,
            token=self.token,
            needs_token=self.has_own_token,
            serves_local_pages=True,
            serves_null_origin=self.serves_null_origin,
            is_open=self.is_open,
            words=AccessWords(
                server=server,
                token="append ?token=… as its log shows, or set its parameter ~allowed_origins to '*'",
                host="add the name to its parameter ~allowed_hosts",
                origin="add it to its parameter ~allowed_origins",
            ),
        )

    @property
    def warning(self) -> str | None:
        """Sentence for the log of a server that serves without a token; None: it does not."""
        if not self.is_open and (self.has_own_token or self.is_public):
            return None
        who = "every machine that reaches it" if self.is_public else "every user of this machine"
        return f"ROS has no access control: {who} may connect here; set ~token to ask for one"

    def url(self, scheme: str, port: int) -> str:
        """URL of the server for the log; with the token if it is required, unless ~token sets it."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        asks_token = not self.is_open and (self.has_own_token or self.is_public)
        query = f"/?token={'…' if self.has_own_token else self.token}" if asks_token else ""
        return f"{scheme}://{host}:{port}{query}"

    def listen(self) -> socket.socket:
        """Bind and listen.

        Raises:
            OSError: the port is taken, or there is no such address.
        """
        family = socket.AF_INET6 if ":" in self.host else socket.AF_INET
        return socket.create_server((self.host, self.port), family=family, backlog=_BACKLOG)


def read_web_address(settings: RosParameters, *, port: int, address: str = "", null_origin: str = "") -> WebAddress:
    """Read the parameters.

    Args:
        settings: the node's private parameters.
        port: default port.
        address: overrides the parameter, as a command line does.
        null_origin: name of the flag that lets pages of files in.

    Raises:
        ParamError: one is invalid.
        UsageError: a name is not a host or an origin.
    """
    asked = settings.integer("port", port, minimum=0)
    if asked > _MAX_PORT:
        raise ParamError(f"parameter {settings.where}/port must be ≤ {_MAX_PORT}, got {asked}")
    origins = _names(settings, "allowed_origins")
    token = settings.text("token", "")
    return WebAddress(
        host=address or settings.text("address", "") or _LOOPBACK,
        port=asked,
        allowed=AllowedNames(
            hosts=_names(settings, "allowed_hosts"), origins=tuple(name for name in origins if name != _EVERYBODY)
        ),
        is_open=_EVERYBODY in origins,
        token=token or secrets.token_urlsafe(16),
        has_own_token=bool(token),
        serves_null_origin=bool(null_origin) and settings.flag(null_origin, default=False),
    )


def _names(settings: RosParameters, name: str) -> tuple[str, ...]:
    """A list, or a text with commas."""
    if name not in settings:
        return ()
    try:
        text = settings.text(name)
    except ParamError:
        return tuple(settings.texts(name))
    return tuple(part.strip() for part in text.split(",") if part.strip())

"""Address and access rules of nodes that serve web pages and programs."""

import secrets
import socket
from dataclasses import dataclass

from trundle.base.http.access import Access, AccessWords
from trundle.base.http.page_address import AllowedNames, is_loopback
from trundle.robots.parameters import ParamError, RosParameters

_LOOPBACK = "127.0.0.1"
_ANY_ORIGIN = "*"
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
    """Value of the parameter, else a random token."""
    has_fixed_token: bool = False
    """True if the parameter sets the token; it is then also required on loopback."""
    serves_null_origin: bool = False

    @property
    def is_public(self) -> bool:
        """True if other machines reach it."""
        return not is_loopback(self.host)

    def access(self, server: str, port: int) -> Access:
        """Return the access rules of the server at its actual port."""
        return Access(
            host=self.host,
            port=port,
            allowed=self.allowed,
            token=self.token,
            needs_token=self.has_fixed_token,
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
        """Warning of a server without a token, for its log; None: it requires one."""
        if not self.is_open and (self.has_fixed_token or self.is_public):
            return None
        clients = "every machine that reaches it" if self.is_public else "every user of this machine"
        return f"ROS has no access control: {clients} may connect here; set ~token to require one"

    def url(self, scheme: str, port: int) -> str:
        """Return the server's URL for the log, with the token if it is required and not set by ~token."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        needs_token = not self.is_open and (self.has_fixed_token or self.is_public)
        query = f"/?token={'…' if self.has_fixed_token else self.token}" if needs_token else ""
        return f"{scheme}://{host}:{port}{query}"

    def listen(self) -> socket.socket:
        """Bind and listen.

        Raises:
            OSError: the port is in use, or the address does not exist.
        """
        family = socket.AF_INET6 if ":" in self.host else socket.AF_INET
        return socket.create_server((self.host, self.port), family=family, backlog=_BACKLOG)


def read_web_address(settings: RosParameters, *, port: int, address: str = "", null_origin: str = "") -> WebAddress:
    """Read the parameters.

    Args:
        settings: node's private parameters.
        port: default port.
        address: overrides the parameter, as on a command line.
        null_origin: name of the flag that allows pages from files.

    Raises:
        ParamError: a parameter is invalid.
        UsageError: a name is neither a host nor an origin.
    """
    port_number = settings.integer("port", port, minimum=0)
    if port_number > _MAX_PORT:
        raise ParamError(f"parameter {settings.namespace}/port must be ≤ {_MAX_PORT}, got {port_number}")
    origins = _read_names(settings, "allowed_origins")
    token = settings.text("token", "")
    return WebAddress(
        host=address or settings.text("address", "") or _LOOPBACK,
        port=port_number,
        allowed=AllowedNames(
            hosts=_read_names(settings, "allowed_hosts"), origins=tuple(name for name in origins if name != _ANY_ORIGIN)
        ),
        is_open=_ANY_ORIGIN in origins,
        token=token or secrets.token_urlsafe(16),
        has_fixed_token=bool(token),
        serves_null_origin=bool(null_origin) and settings.flag(null_origin, default=False),
    )


def _read_names(settings: RosParameters, name: str) -> tuple[str, ...]:
    """Read a list, or a text with commas."""
    if name not in settings:
        return ()
    try:
        text = settings.text(name)
    except ParamError:
        return tuple(settings.texts(name))
    return tuple(part.strip() for part in text.split(",") if part.strip())

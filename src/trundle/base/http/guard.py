"""Guard of a web server: applies `Access` to requests, and answers refused ones.

Responses to wrong tokens are delayed, so that guessing is slow.
"""

import asyncio

from aiohttp import web

from .access import Access, PageRequest, Refusal
from .link_request import LINK_REQUEST, POLICY

GUESS_S = 1.0
"""Delay of the response to a wrong token [s]."""
_MAX_WAITING = 64
_FIELDS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


_DECIDING = ("Host", "Origin")
"""Fields that a request may have only once: of several, proxies and browsers may read different ones."""
_OTHER_SITES = ("cross-site", "same-site")
"""Values of Sec-Fetch-Site for requests of other pages; same-site: of another port of this host."""


class Guard:
    """Guard of one server: every request passes it first."""

    def __init__(self, access: Access, *, is_page: bool = False) -> None:
        """Prepare.

        Args:
            access: decides which requests are served.
            is_page: True for the page: browsers open it by its link, and other sites' pages show no part of it.
        """
        self._access = access
        self._is_page = is_page
        self._waiting = 0

    def read(self, request: web.Request) -> PageRequest:
        """Read the fields of a request that decide access."""
        headers = request.headers
        return PageRequest(
            target=request.raw_path,
            host=headers.get("Host"),
            origin=headers.get("Origin"),
            cookie="; ".join(headers.getall("Cookie", [])),
            is_embedded=self._is_page
            and headers.get("Sec-Fetch-Mode") == "no-cors"
            and headers.get("Sec-Fetch-Site") in _OTHER_SITES,
        )

    async def refuse(self, request: web.Request) -> web.Response | None:
        """Return the answer to a request that is refused; None: it is served."""
        repeated = [name for name in _DECIDING if len(request.headers.getall(name, [])) > 1]
        refusal = Refusal(f"duplicate header {repeated[0]}") if repeated else self._access.refusal(self.read(request))
        return None if refusal is None else await self._answer(request, refusal)

    async def _answer(self, request: web.Request, refusal: Refusal) -> web.Response:
        """Answer a refused request; a browser that opens the page gets a document that asks for the link."""
        if refusal.is_guess:
            if self._waiting >= _MAX_WAITING:
                text = f"refused: {_MAX_WAITING} wrong tokens are being answered\n"
                return web.Response(status=429, text=text, headers=_FIELDS | {"Connection": "close"})
            self._waiting += 1
            try:
                await asyncio.sleep(GUESS_S)
            finally:
                self._waiting -= 1
        opens_page = request.path == "/" and "text/html" in request.headers.get("Accept", "")
        if self._is_page and refusal.asks_token and opens_page:
            headers = _FIELDS | {"Content-Security-Policy": POLICY}
            return web.Response(status=403, text=LINK_REQUEST, content_type="text/html", headers=headers)
        return web.Response(status=403, text=f"refused: {refusal.text}\n", headers=_FIELDS)

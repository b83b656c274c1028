"""Answers to requests that `Access` refuses; those to wrong tokens come late, so that guessing is slow."""

import asyncio

from aiohttp import web

from trundle.base.http.access import Refusal

from .link_request import LINK_REQUEST, POLICY

GUESS_S = 1.0
"""Delay of the answer to a wrong token; a right one is served at once."""
_MAX_WAITING = 64
_FIELDS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class Refusals:
    """Answers of one server."""

    def __init__(self, *, has_link: bool = False) -> None:
        """Prepare; `has_link`: True if browsers open the server by the link of a page."""
        self._has_link = has_link
        self._waiting = 0

    async def answer(self, request: web.Request, refusal: Refusal) -> web.Response:
        """Answer a request; a browser that opens the page gets a document that asks for the link."""
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
        if self._has_link and refusal.asks_token and opens_page:
            headers = _FIELDS | {"Content-Security-Policy": POLICY}
            return web.Response(status=403, text=LINK_REQUEST, content_type="text/html", headers=headers)
        return web.Response(status=403, text=f"refused: {refusal.text}\n", headers=_FIELDS)

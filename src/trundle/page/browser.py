"""The user's browser, opened on a page."""

import atexit
import os
import sys
import threading
import webbrowser
from collections.abc import Callable, Mapping
from html import escape
from pathlib import Path
from typing import Protocol

from trundle.base.http.page_address import PageAddress
from trundle.base.ownership import write_private_file


class ServedPage(Protocol):
    """URLs of a page."""

    @property
    def url(self) -> str: ...
    @property
    def view_url(self) -> str: ...


def announce_page(page: ServedPage, at: PageAddress, say: Callable[[str], None], *, opens_browser: bool = True) -> None:
    """Print the link to a page, and open it in the browser if a user sees this terminal.

    Args:
        page: running page.
        at: requested address.
        say: prints a line.
        opens_browser: False: print only.
    """
    say(f"see it at {page.url}")
    if at.view_only:
        say(f"view-only link: {page.view_url}")
    if opens_browser and sys.stdout.isatty() and sys.stderr.isatty():
        threading.Thread(target=_open, args=(page.url,), daemon=True).start()  # starting a browser takes seconds


def _open(url: str) -> None:
    """Open a link through a file that redirects to it: all users may read the arguments of a browser's process."""
    if has_browser(os.environ) and (file := write_redirect(url)) is not None:
        atexit.register(file.unlink, missing_ok=True)
        webbrowser.open(file.as_uri())


def write_redirect(url: str) -> Path | None:
    """Write a document that redirects to a link and that only this user may read."""
    text = f'''<!doctype html>
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={escape(url)}">
<title>Trundle</title>
<p><a href="{escape(url)}">Open the page</a></p>
'''
    return write_private_file(f"open-{os.getpid()}.html", text.encode(), os.environ)


def has_browser(env: Mapping[str, str]) -> bool:
    """True if a graphical browser can be opened, or $BROWSER names a program."""
    if env.get("BROWSER"):
        return True
    if sys.platform in ("win32", "darwin"):
        return "SSH_CONNECTION" not in env
    if not (env.get("DISPLAY") or env.get("WAYLAND_DISPLAY")):
        return False
    try:
        browser = webbrowser.get()
    except webbrowser.Error:
        return False
    # Only browsers in the terminal, such as lynx, are of exactly this class.
    return type(browser) is not webbrowser.GenericBrowser

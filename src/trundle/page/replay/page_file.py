"""Recording as one HTML file, which shows it without Trundle and without a network."""

import base64
import gzip
import re
from collections.abc import Mapping
from html import escape
from string import Template

import msgspec

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.http.html_policy import policy_of_viewer
from trundle.page import REPLAY_FILES

from ..scene_settings import scene_settings
from ..world.manifest import SceneSettings
from .recorded_motion import RecordedMotion, animated_world

_PAGE = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
$policy
<meta name="viewport" content="width=device-width, initial-scale=1, viewport-fit=cover">
<title>$title</title>
<style>$style</style>
</head>
<body>
<div id="app"></div>
<script type="application/json" id="about">$about</script>
<script type="text/plain" id="world">$world</script>
<script type="module">$script</script>
<script type="text/plain" id="licenses">$licenses</script>
</body>
</html>
""")


class ReplayAbout(msgspec.Struct, frozen=True, kw_only=True):
    """Metadata of the recording in a replay's file."""

    title: str
    start: float
    """Simulated time [s]."""
    end: float
    """Simulated time [s]."""
    scene: SceneSettings
    view: Mapping[str, object] | None
    """The view at first, as in an .rviz file; None: all that moves is framed."""


def replay_page(motion: RecordedMotion, report: Diagnostics, *, view: Mapping[str, object] | None = None) -> str:
    """Return the HTML.

    Args:
        motion: what it shows.
        report: takes shapes that are not drawn.
        view: the view from which it is seen first, as an .rviz file has it; None: all that moves is framed.

    Raises:
        UsageError: the viewer is not built.
    """
    try:
        script, style, licenses = (file.read_text(encoding="utf-8") for file in REPLAY_FILES)
    except OSError:
        raise UsageError("the page's client is not built, and a replay contains a part of it: run make") from None
    world = gzip.compress(animated_world(motion, report), mtime=0)
    about = ReplayAbout(
        title=motion.title,
        start=float(motion.times[0]),
        end=float(motion.times[-1]),
        scene=scene_settings(motion.world),
        view=view,
    )
    own = _inert(script)
    return _PAGE.substitute(
        policy=policy_of_viewer(own),
        title=escape(motion.title),
        style=style,
        about=msgspec.json.encode(about).decode().replace("<", "\\u003c"),
        world=base64.b64encode(world).decode(),
        script=own,
        licenses=_inert(licenses),
    )


def _inert(text: str) -> str:
    """Return a script or text in which nothing ends the element around it."""
    return re.sub("<(/script|!--)", r"\\x3C\1", text, flags=re.IGNORECASE)

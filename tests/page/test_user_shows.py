"""A user shows and hides parts of a simulated world; areas of the picture are checked."""

import json
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import ImageColor
from tests.page.built_client import needs_client
from tests.page.scene_user import PX_PER_M, Point
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]

Picture = NDArray[np.uint8]
Mask = NDArray[np.bool_]


def _shapes(collision: str, visual: str, rgb: str) -> str:
    """Return a collision and a visual, boxes of these sizes; the visual glows in a color."""
    box = "<geometry><box><size>{}</size></box></geometry>"
    black = "<ambient>0 0 0 1</ambient><diffuse>0 0 0 1</diffuse>"
    material = f"<material>{black}<emissive>{rgb} 1</emissive></material>"
    visible = f'<visual name="v">{box.format(visual)}{material}</visual>'
    return f'<collision name="c">{box.format(collision)}</collision>{visible}'


MASS = """<inertial><pose>0 0 0 0 0 0.5</pose><mass>2</mass>
<inertia><ixx>0.05</ixx><iyy>0.03</iyy><izz>0.06</izz></inertia></inertial>"""
BOX_M = (0.346, 0.49)
"""Length and width of the uniform box with this mass and inertia: √(6 (iyy + izz − ixx) / m), …"""
EYE = """<sensor name="eye" type="camera"><pose>0.3 0 0 0 0 0</pose><camera><horizontal_fov>1.5708</horizontal_fov>
<image><width>80</width><height>60</height></image><clip><near>0.1</near><far>0.5</far></clip></camera></sensor>"""
_RANGE = "<range><min>0.05</min><max>4</max></range>"
_FAN = "<horizontal><samples>40</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></horizontal>"
SCAN = f"""<sensor name="scan" type="ray"><pose>0.35 0 0.1 0 0 0</pose><update_rate>50</update_rate>
<ray><scan>{_FAN}</scan>{_RANGE}</ray></sensor>"""
SONAR = """<sensor name="sonar" type="sonar"><pose>0 0.25 0.1 1.5708 0 0</pose><update_rate>50</update_rate>
<sonar><min>0.05</min><max>0.8</max><radius>0.2</radius></sonar></sensor>"""
FLOOR = "<collision name='c'><geometry><box><size>9 9 0.2</size></box></geometry></collision>"
WORLD = f"""<sdf version="1.6"><world name="yard"><wind><linear_velocity>3 0 0</linear_velocity></wind>
<scene><background>0 0 0 1</background><grid>0</grid></scene>
<model name="floor"><static>1</static><pose>0 0 -0.099 0 0 0</pose><link name="base">{FLOOR}</link></model>
<model name="crate"><pose>-1 0 0.2 0 0 0</pose>
<link name="base">{MASS}{_shapes("0.6 0.4 0.4", "0.4 0.4 0.4", "1 0 0")}{SCAN}{SONAR}</link></model>
<model name="gate"><pose>1 0 0.2 0 0 0</pose>
<link name="base"><inertial><mass>9</mass></inertial>{_shapes("0.4 0.4 0.4", "0.4 0.4 0.4", "0 0 1")}{EYE}</link>
<link name="flap"><pose>0 0.6 0.1 0 0 0</pose>{_shapes("0.2 0.2 0.2", "0.2 0.2 0.2", "0 0 1")}</link>
<joint name="hinge" type="revolute"><pose>0 -0.1 0 0 0 0</pose><parent>base</parent><child>flap</child>
<axis><xyz>0 0 1</xyz><limit><lower>0</lower><upper>1.5708</upper></limit></axis></joint></model></world></sdf>"""
RECORD_SENT = """
window.sent = []; // text messages to the server, which a worker sends
const post = Worker.prototype.postMessage;
Worker.prototype.postMessage = function (message, ...others) {
  if (message?.kind === "send" && typeof message.frame === "string") window.sent.push(message.frame);
  return post.call(this, message, ...others);
};
"""
RED, BLUE = (255, 0, 0), (0, 0, 255)


class Viewer(WorldUser):
    """Shows and hides parts; measures changed areas of the picture."""

    def __init__(self, browser: Any, url: str) -> None:
        super().__init__(browser, url)
        self.page.add_init_script(RECORD_SENT)
        self.page.reload()
        self.page.get_by_label("Connected").first.wait_for()

    def is_subscribed(self, topic: str) -> bool:
        """True while the page subscribes to a topic."""
        channel = self._client.channels[topic]["id"]
        subscriptions: set[int] = set()
        for message in map(json.loads, self.page.evaluate("window.sent")):
            subscriptions |= {
                entry["id"] for entry in message.get("subscriptions", []) if entry["channelId"] == channel
            }
            subscriptions -= set(message.get("subscriptionIds", []))
        return bool(subscriptions)

    def show(self, *parts: str) -> None:
        """Choose entries of the View menu."""
        self.button("Show in the view").click()
        for part in parts:
            self.page.get_by_role("menuitemcheckbox", name=part, exact=True).click()
        self.page.keyboard.press("Escape")

    def toggle(self, model: str, part: str) -> None:
        """Show or hide a part of one model in its inspector."""
        self.pick(model)
        self.page.locator(".inspector").get_by_role("button", name=part, exact=True).click()
        self.run("Clear the selection")

    def run(self, command: str) -> None:
        """Run a command by its name."""
        self.page.keyboard.press("Control+k")
        self.page.get_by_role("combobox", name="Search commands").fill(command)
        self.page.keyboard.press("Enter")

    def has_color(self, point: Point, color: tuple[int, ...]) -> bool:
        """Tell if the picture has a color at a point of the ground, shaded or not."""
        row, column = round((1.5 - point[1]) * PX_PER_M), round((point[0] + 2.5) * PX_PER_M)
        shown = self.picture()[row, column].astype(float)
        return bool(np.abs(shown / max(shown.max(), 1) - np.array(color) / max(color)).max() < 0.08)

    def is_shown(self, part: str) -> bool:
        self.button("Show in the view").click()
        checked = self.page.get_by_role("menuitemcheckbox", name=part, exact=True).get_attribute("aria-checked")
        self.page.keyboard.press("Escape")
        return checked == "true"

    def until_changed(self, before: Picture, where: Callable[[Mask], object], what: str = "") -> None:
        """Wait until the mask (height, width) of changed pixels fulfils a condition."""
        self.until(lambda: where(np.any(self.picture() != before, axis=-1)), what=what)


def _within(mask: Mask, x: tuple[float, float], y: tuple[float, float]) -> Mask:
    """Return the part of a mask between coordinates of the ground [m]."""
    columns = slice(round((x[0] + 2.5) * PX_PER_M), round((x[1] + 2.5) * PX_PER_M))
    return mask[round((1.5 - y[1]) * PX_PER_M) : round((1.5 - y[0]) * PX_PER_M), columns]


def _area(mask: Mask) -> float:
    """Return the area of a mask [m²]."""
    return float(mask.sum() / PX_PER_M**2)


@pytest.fixture(scope="module")
def user(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Viewer]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        user = Viewer(chromium, url)
        user.run("Show or hide the cameras")
        user.look_down()
        user.run("Clear the selection")
        user.until_area(RED, 0.16)
        yield user
        user.close()


def test_visuals_are_hidden_transparent_or_wireframes(user: Viewer) -> None:
    user.show("Visuals")
    user.until_area(RED, 0)
    assert user.area(BLUE) == 0
    user.show("Visuals", "Transparent")
    user.until_area((128, 0, 0), 0.16)
    user.show("Transparent", "Wireframe")
    user.until(lambda: 0 < user.area(RED) < 0.05)
    user.show("Wireframe")
    user.until_area(RED, 0.16)


def test_collisions_are_drawn_around_smaller_visuals(user: Viewer) -> None:
    before = user.picture()
    user.toggle("crate", "Collisions")
    user.until_changed(before, lambda mask: _within(mask, (-1.28, -1.22), (-0.15, 0.15)).all())
    user.until_changed(before, lambda mask: not _within(mask, (0.5, 2.4), (-1.4, 1.4)).any())
    user.toggle("crate", "Collisions")
    user.until_changed(before, lambda mask: not mask.any())


def test_an_inertia_is_drawn_as_the_uniform_box(user: Viewer) -> None:
    """It is shown for one model by its inspector, along the principal axes."""
    before = user.picture()
    user.toggle("crate", "Inertias")
    user.until_changed(before, lambda mask: abs(_area(mask) - BOX_M[0] * BOX_M[1]) < 0.01)
    user.until_changed(before, lambda mask: not _within(mask, (0, 2.4), (-1.4, 1.4)).any())
    user.toggle("crate", "Inertias")
    user.until_changed(before, lambda mask: not mask.any())


def test_a_joints_range_and_a_links_axes_are_drawn(user: Viewer) -> None:
    """The hinge, at x = 1 and y = 0.5, turns from x to y, and so does its sector."""
    before = user.picture()
    user.show("Joints")
    user.until_changed(before, lambda mask: _within(mask, (1.01, 1.04), (0.51, 0.54)).all(), what="for the sector")
    user.until_changed(before, lambda mask: not _within(mask, (0.8, 0.97), (0.42, 0.48)).any())
    user.show("Joints", "Link frames")
    user.until_changed(before, lambda mask: _within(mask, (-1.0, -0.9), (0, 0.01)).all(), what="for the x axis")
    user.show("Link frames", "Centers of mass")
    user.until_changed(before, lambda mask: 1e-4 < _area(_within(mask, (-1.2, -0.8), (-0.2, 0.2))) < 0.01)
    user.show("Centers of mass")
    user.until_changed(before, lambda mask: not mask.any())


def _axes_are_painted(user: Viewer, theme: str) -> bool:
    """Tell if x and y of the world's origin have the theme's colors; z points at the camera."""
    colors = user.page.evaluate(
        "['--x', '--y'].map((one) => getComputedStyle(document.documentElement).getPropertyValue(one).trim())"
    )
    assert user.page.evaluate("document.documentElement.dataset.theme") == theme
    along_x, along_y = (ImageColor.getrgb(color) for color in colors)
    return all(user.has_color(point, color) for point, color in (((0.4, 0.0), along_x), ((0.0, 0.4), along_y)))


def test_axes_have_the_colors_of_the_theme(user: Viewer) -> None:
    """Those of the world's origin, and those of a frame, which an rviz display draws."""
    for part in ("World origin", "Axes"):
        if part == "Axes":
            user.side("Displays")
            user.button("Add").click()
            user.page.get_by_role("tab", name="By class").click()
            user.button("Add Axes").click()
        else:
            user.show(part)
        for _ in range(2):
            theme = user.page.evaluate("document.documentElement.dataset.theme")
            user.until(lambda theme=theme: _axes_are_painted(user, theme), what=f"for {part} in {theme}")
            user.page.get_by_role("button", name="Dark theme" if theme == "light" else "Light theme").click()
        if part == "World origin":
            user.show(part)
    user.button("Remove").click()
    user.side("Inspector")
    user.until(lambda: user.picture()[100, 250].max() == 0, what="for no axes")  # the green one was there


def test_a_cameras_frustum_is_drawn(user: Viewer) -> None:
    """It extends from x = 1.3 by half a metre, as wide as it is long on each side."""
    before = user.picture()
    user.show("Cameras")
    user.until_changed(before, lambda mask: _within(mask, (1.78, 1.82), (-0.4, 0.4)).any(axis=1).all())
    user.show("Cameras")
    user.until_changed(before, lambda mask: not mask.any())


def test_contacts_are_subscribed_to_while_they_are_shown(user: Viewer) -> None:
    """After a step, the crate rests on the corners of its collision."""
    user.button("Step 1").click()
    before = user.picture()
    assert not user.is_subscribed("trundle/contacts")
    user.show("Contacts")
    corners = [(-1 + 0.3 * x, 0.2 * y) for x in (-1, 1) for y in (-1, 1)]
    around = [((x - 0.01, x + 0.01), (y - 0.01, y + 0.01)) for x, y in corners]
    user.until_changed(before, lambda mask: all(_within(mask, *corner).any() for corner in around))
    assert user.is_subscribed("trundle/contacts")
    user.show("Contacts")
    user.until_changed(before, lambda mask: not mask.any())
    assert not user.is_subscribed("trundle/contacts")


def test_lidars_and_sonars_are_drawn_while_they_are_shown(user: Viewer) -> None:
    """Forty rays from x = −0.65 to the gate's face at x = 0.8; the sonar looks along y and hits nothing."""
    before = user.picture()
    user.show("Lidar points", "Sonar cones")
    user.button("Play").click()
    user.until_changed(before, lambda mask: _within(mask, (0.78, 0.83), (-0.15, 0.15)).mean() > 0.2)
    user.page.get_by_role("banner").get_by_role("button", name="Pause").click()
    user.until_changed(before, lambda mask: _within(mask, (-1.2, -0.8), (0.8, 1.04)).mean() > 0.1)
    user.until_changed(before, lambda mask: not _within(mask, (-0.6, 0.7), (-0.1, 0.1)).any())
    user.show("Lidar points", "Sonar cones", "Lidar rays")
    user.until_changed(before, lambda mask: _within(mask, (-0.6, 0.7), (-0.02, 0.02)).mean() > 0.2)
    user.show("Lidar rays")
    user.until_changed(before, lambda mask: not mask.any())
    assert not user.is_subscribed("trundle/ranges")


def test_wind_and_origin_are_marked_and_remembered(user: Viewer) -> None:
    """They are shown by the palette, and still after a reload."""
    before = user.picture()
    user.run("Show or hide wind")
    user.until_changed(before, lambda mask: _within(mask, (0.1, 0.3), (-0.02, 0.02)).any(axis=0).all())
    user.run("Show or hide world origin")
    user.until_changed(before, lambda mask: _within(mask, (-0.01, 0.01), (0.2, 0.8)).any(axis=1).all())
    user.page.reload()
    user.page.get_by_label("Connected").first.wait_for()
    user.until(lambda: user.button("Show in the view").is_visible())
    assert user.is_shown("Wind")
    assert user.is_shown("World origin")
    assert not user.is_shown("Grid")
    user.look_down()
    user.run("Clear the selection")
    user.until_changed(before, lambda mask: _within(mask, (-0.01, 0.01), (0.2, 0.8)).any(axis=1).all())
    user.show("Wind", "World origin")
    user.until_changed(before, lambda mask: not mask.any())

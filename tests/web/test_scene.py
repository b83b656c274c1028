"""Interaction with the scene: mouse, touch, tools; and the page without WebGL."""

from collections.abc import Iterator
from typing import Any

import pytest


@pytest.fixture
def page(chromium: Any, served: str) -> Iterator[Any]:
    """Open the page of web/test/harness/scene.html: a box of 1 m at the origin, points, lines and frames."""
    page = chromium.new_page(viewport={"width": 800, "height": 600}, has_touch=True)
    page.goto(f"{served}/scene.html")
    _draw(page)
    yield page
    page.close()


def _draw(page: Any) -> None:
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def _view(page: Any) -> dict[str, Any]:
    return page.evaluate("Object.fromEntries(views.current.value.properties.map((p) => [p.name, p.value.value]))")


def _color(page: Any, x: int, y: int) -> tuple[int, ...]:
    from io import BytesIO

    from PIL import Image

    pixel = Image.open(BytesIO(page.screenshot())).convert("RGB").getpixel((x, y))
    assert isinstance(pixel, tuple)
    return pixel


def test_the_scene_is_drawn_in_exact_colors_and_only_after_changes(page: Any) -> None:
    """A flat color keeps its sRGB values, and a still scene is not redrawn."""
    assert _color(page, 400, 310) == (0x40, 0x80, 0xC0)
    page.evaluate("window.count = 0; void scene.addStep({ before: () => { count += 1 } })")
    _draw(page)
    last = _count_once_still(page)
    page.set_viewport_size({"width": 500, "height": 700})
    page.wait_for_function("scene.element.width === 500 && scene.element.height === 700")
    page.wait_for_function(f"count > {last}")


def _count_once_still(page: Any) -> int:
    """Wait until no more pictures are drawn, as the start may take a few; return their number."""
    for _ in range(100):
        before = page.evaluate("count")
        page.wait_for_timeout(700)  # the sharp picture comes after 300
        if page.evaluate("count") == before:
            return before
    raise AssertionError("a still scene is drawn again and again")


def test_mouse_and_keys_move_the_camera_as_in_rviz(page: Any) -> None:
    """The left button turns, the middle one pans, the wheel and + zoom, arrows turn, axes set side views."""
    start = _view(page)
    page.mouse.move(400, 300)
    page.mouse.down()
    page.mouse.move(440, 320, steps=3)
    page.mouse.up()
    turned = _view(page)
    assert turned["Yaw"] == pytest.approx(start["Yaw"] - 0.2)
    assert turned["Pitch"] == pytest.approx(start["Pitch"] + 0.1)
    page.mouse.down(button="middle")
    page.mouse.move(460, 300, steps=3)
    page.mouse.up(button="middle")
    assert _view(page)["Focal Point"] != turned["Focal Point"]
    page.mouse.wheel(0, -200)
    page.wait_for_function(f"views.current.value.distance.value.value < {start['Distance']}")
    nearer = _view(page)["Distance"]
    page.keyboard.press("-")
    page.keyboard.press("ArrowRight")
    assert _view(page)["Distance"] > nearer
    assert _view(page)["Yaw"] > turned["Yaw"]
    page.get_by_label("Look from top").click()
    page.wait_for_function("views.current.value.pitch.value.value > 1.569")


def test_touches_turn_pan_and_zoom(page: Any) -> None:
    """One finger turns; spreading two zooms in."""
    touch = page.context.new_cdp_session(page)

    def send(kind: str, *points: tuple[int, int]) -> None:
        positions = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": positions})

    start = _view(page)
    send("touchStart", (400, 300))
    send("touchMove", (440, 300))
    _draw(page)
    send("touchEnd")
    assert _view(page)["Yaw"] == pytest.approx(start["Yaw"] - 0.2)
    send("touchStart", (380, 300), (420, 300))
    _draw(page)
    send("touchMove", (300, 300), (500, 300))
    _draw(page)
    send("touchEnd")
    assert _view(page)["Distance"] == pytest.approx(start["Distance"] / 5)
    assert _view(page)["Focal Point"] == pytest.approx(start["Focal Point"], abs=0.01)


def test_a_click_selects_and_a_goal_is_published(page: Any) -> None:
    """The tools act on the object under the pointer."""
    page.mouse.click(400, 310)
    assert page.evaluate("selection.value") == {"kind": "picked", "title": "Marker", "fields": {"Namespace": "boxes"}}
    page.evaluate("tools.use('rviz/SetGoal')")
    x, y = 400, 420
    ground = page.evaluate(f"scene.pickGround({x}, {y}).toArray()")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 80, y, steps=3)
    page.mouse.up()
    [sent] = page.evaluate("connection.published")
    assert sent["topic"] == "/move_base_simple/goal"
    assert sent["message"]["header"]["frame_id"] == "map"
    assert [sent["message"]["pose"]["position"][axis] for axis in "xy"] == pytest.approx(ground[:2])
    assert page.evaluate("tools.current.value.name") == "Interact"


def test_a_lost_context_is_shown_and_restored(page: Any) -> None:
    """The browser may release the graphics context for a while."""
    page.evaluate("window.loss = scene.element.getContext('webgl2').getExtension('WEBGL_lose_context')")
    page.evaluate("loss.loseContext()")
    page.wait_for_function("scene.status.value.kind === 'lost'")
    page.evaluate("loss.restoreContext()")
    page.wait_for_function("scene.status.value.kind === 'drawing'")
    _draw(page)
    assert _color(page, 400, 310) == (0x40, 0x80, 0xC0)


def test_without_webgl_the_page_shows_a_notice_and_works(chromium: Any, served: str) -> None:
    """Labels, axes and tools still exist."""
    page = chromium.new_page()
    faults: list[str] = []

    def note(error: Any) -> None:
        faults.append(str(error))

    page.on("pageerror", note)
    stub = "const get = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext ="
    page.add_init_script(
        f"{stub} function (kind, ...rest) {{ return kind === '2d' ? get.call(this, kind, ...rest) : null }}"
    )
    page.goto(f"{served}/scene.html")
    _draw(page)
    status = page.evaluate("scene.status.value")
    assert status["kind"] == "unsupported"
    assert "WebGL" in status["reason"]
    page.get_by_label("Look from top").click()
    page.wait_for_function("views.current.value.pitch.value.value > 1.5")
    page.close()
    assert faults == []


_ONE_BOX = """() => {
    for (const one of scene.displays.children) one.visible = one.name === "Marker";
    scene.grid.value = false;
    window.count = 0;
    scene.addStep({ before: () => { count += 1 } });
    window.keepOn = scene.onTick(() => scene.invalidate());
}"""


def _shares(page: Any, ratio: int) -> list[float]:
    """Return the shares of the box' color in the pixels that are neither it nor the background, within the picture."""
    from io import BytesIO

    import numpy as np
    from PIL import Image

    picture = np.asarray(Image.open(BytesIO(page.screenshot())).convert("RGB")).astype(float)[:, : 700 * ratio]
    box, background = np.array([0x40, 0x80, 0xC0]), picture[0, 0]
    share = ((picture - background) @ (box - background)) / ((box - background) @ (box - background))
    return [float(one) for one in share[(share > 0.03) & (share < 0.97)]]


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1, 2])
def test_a_scene_at_rest_has_smooth_edges_in_one_more_picture(chromium: Any, served: str, ratio: int) -> None:
    """The CPU draws: edges have steps while something changes, and four samples per pixel afterwards."""
    context = chromium.new_context(viewport={"width": 800, "height": 600}, device_scale_factor=ratio)
    page = context.new_page()
    page.goto(f"{served}/scene.html")
    _draw(page)
    page.evaluate(_ONE_BOX)
    page.wait_for_function("count > 2")
    if ratio == 1:
        assert _shares(page, ratio) == [], "edges are smooth while the picture changes"
    assert page.evaluate("scene.element.width * scene.element.height") <= 1e6

    count = page.evaluate("keepOn(); count")
    page.wait_for_function(f"scene.element.width === {800 * ratio} && count > {count}")
    rested = _count_once_still(page)
    assert rested - count <= 2, "the picture that was due, and the sharp one"
    shares = _shares(page, ratio)
    assert len(shares) > 200 * ratio
    levels = {round(4 * one) for one in shares}
    assert levels >= {1, 2, 3}
    page.wait_for_timeout(1000)
    assert page.evaluate("count") == rested, "drawn while nothing changes"

    page.evaluate("scene.invalidate()")
    page.wait_for_function(f"count > {rested}")
    context.close()

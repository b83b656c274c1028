"""Names keep their place and width while the numbers beside them change."""

from typing import Any

import pytest
from tests.page.panel_user import PATIENCE_MS

pytestmark = pytest.mark.slow

_NAMES = """() => Object.fromEntries([...document.querySelectorAll(
    ".row .n, .kv > span:first-child, .jt .n, .twist3 > *, .nf .axis, .limit > :not(output), .bar > *, .legend .n,"
    + " .data th, .data td:first-child, .figures dt, .axes dt, .tile .cap .n")]
    .filter((one) => one.checkVisibility())
    .map((one, index) => {
        const { left, width } = one.getBoundingClientRect();
        const text = one.matches(".n, dt, th, td, .kv > *") ? one.textContent : "";
        return [`${index} ${one.tagName} ${text}`, [left, width]];
    }))"""
_SET = """(value) => {
    const size = Math.abs(value);
    page.world.joints.value = [1, 2, 3, 4, 5].map(() => ({
        position: Math.max(-1.5, Math.min(1.5, value)), velocity: value, effort: value }));
    page.world.state.value = { ...page.world.state.value, real_time_factor: size / 10, time_ns: size * 1e9 };
    const statistics = { rate: 9 * size, bandwidth: 1e5 * size, count: 1, dropped: Math.round(size) };
    page.connection.statistics = () => ({ ...statistics, lastAt: performance.now() - 1000 * size });
    const time = BigInt(Math.round(performance.now() * 1e6));
    page.connection.receive("/odom", { twist: { twist: { linear: { x: value } } } }, { time });
    page.connection.receive("/cmd_vel", { linear: { x: value } }, { time });
}"""
_TOPICS = """() => {
    page.connection.advertise("/odom", "nav_msgs/Odometry");
    page.connection.advertise("/cmd_vel", "geometry_msgs/Twist");
}"""
VALUES = (0.42, -0.21, 9.99, -9.99, 1.0)


def _places(tab: Any, value: float) -> Any:
    """Return left edges and widths of the names beside a value's numbers."""
    tab.evaluate(_SET, value)
    for _ in range(3):
        tab.evaluate("new Promise((done) => setTimeout(() => requestAnimationFrame(done), 250))")  # panels tick at 5 Hz
    return tab.evaluate(_NAMES)


def _changes(tab: Any) -> list[str]:
    """Return the names that move while the values change."""
    first = _places(tab, VALUES[0])
    assert len(first) > 5
    moved: list[str] = []
    for value in VALUES[1:]:
        now = _places(tab, value)
        moved += [f"{value}: {name}: {first[name]} → {now.get(name)}" for name in first if now.get(name) != first[name]]
    return moved


@pytest.mark.parametrize("panel", ["Plots", "Topics"])
def test_names_keep_their_width(chromium: Any, served: str, panel: str) -> None:
    tab = chromium.new_page(viewport={"width": 1440, "height": 900})
    tab.set_default_timeout(PATIENCE_MS)
    tab.goto(f"{served}/shell.html")
    tab.locator(".dv-tab", has_text=panel).first.click()
    tab.evaluate(_TOPICS)
    tab.locator(".legend li" if panel == "Plots" else ".data tbody tr").nth(1).wait_for()
    moved = _changes(tab)
    tab.close()
    assert moved == []


@pytest.mark.parametrize("sheet", ["World", "Inspector", "Plots"])
def test_names_keep_their_width_on_a_phone(chromium: Any, served: str, sheet: str) -> None:
    tab = chromium.new_page(viewport={"width": 390, "height": 844})
    tab.set_default_timeout(PATIENCE_MS)
    tab.goto(f"{served}/shell.html")
    tab.evaluate(_TOPICS)
    tab.get_by_role("navigation").get_by_role("button", name=sheet).click()
    moved = _changes(tab)
    tab.close()
    assert moved == []


def test_the_measure_finds_a_name_that_moves(chromium: Any, served: str) -> None:
    tab = chromium.new_page(viewport={"width": 1440, "height": 900})
    tab.set_default_timeout(PATIENCE_MS)
    tab.goto(f"{served}/shell.html")
    tab.locator(".dv-tab").first.wait_for()
    tab.add_style_tag(content=".steady { min-width: 0 !important } .jt .n { flex: 1 }")
    moved = _changes(tab)
    tab.close()
    assert any("SPAN camera_base_camera" in name for name in moved), moved

"""A user opens lessons, reads hostile ones, and goes through those that Trundle brings by doing what they say."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import free_port
from tests.page.built_client import needs_client
from tests.page.lesson_user import LessonUser
from tests.page.panel_user import PanelUser
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session

pytestmark = needs_client

HOSTILE = """---
start: trundle run <b>x</b>
needs: {model: "<img src=x onerror=alert(1)>"}
---
# A <b>hostile</b> lesson

<script>document.body.dataset.hacked = 1</script>

<img src=x onerror="document.body.dataset.hacked = 1">

[script](javascript:alert(1)) [page](https://example.org/a?b=1&c=2) ![picture](https://example.org/track.png)

```js title="<b>.js"
</code><script>document.body.dataset.hacked = 1</script>
```

## Write a file

```check
file: {file}
```

```look
insert
topics
```

## The end
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("lesson")


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[PageServer]:
    lesson = folder / "hostile.md"
    lesson.write_text(HOSTILE.replace("{file}", str(folder / "a.yaml")))
    session = Session(title="test", kind="simulation", lesson=str(lesson))
    with PageServer.start(session, at=PageAddress(port=0)) as server:
        yield server


@pytest.fixture
def reader(chromium: Any, server: PageServer, folder: Path) -> Iterator[LessonUser]:
    user = PanelUser(chromium, server.url)
    yield LessonUser(user, folder, {})
    user.close()


def test_a_hostile_lesson_is_shown_as_text_and_its_file_is_checked(reader: LessonUser, folder: Path) -> None:
    reader.at("A <b>hostile</b> lesson")
    reader.step.get_by_text("This lesson is about another world").wait_for()
    text = reader.step.inner_text()
    assert "<script>document.body.dataset.hacked = 1</script>" in text
    assert '<img src=x onerror="document.body.dataset.hacked = 1">' in text
    assert "script" in text
    assert "trundle run <b>x</b>" in text
    assert reader.step.locator("img, script, b, iframe").count() == 0
    links = reader.step.locator("a").evaluate_all("all => all.map(a => [a.href, a.target, a.rel])")
    assert links == [["https://example.org/a?b=1&c=2", "_blank", "noopener noreferrer"]]
    code = reader.copy(reader.page.get_by_role("button", name="Copy <b>.js"))
    assert code == "</code><script>document.body.dataset.hacked = 1</script>"
    assert reader.page.evaluate("document.body.dataset.hacked") is None

    reader.next()
    reader.at("Write a file")
    reader.user.until(lambda: reader.rings('[data-tab-panel-id="topics"]'), what="for the mark of Topics")
    reader.step.get_by_text("it does not exist").wait_for()
    (folder / "a.yaml").write_text("a: [\n")
    reader.step.get_by_text("line 2, column 1").wait_for()
    (folder / "a.yaml").write_text("a: 1\n")
    reader.until_done()
    reader.page.reload()
    reader.at("Write a file")  # the browser remembers the step, and what is done
    reader.until_done()
    reader.next()
    reader.at("The end")
    reader.page.locator(".lesson-ring").first.wait_for(state="detached")
    reader.page.get_by_role("button", name="Finish").click()
    reader.page.get_by_role("tab", name="Lesson").wait_for(state="detached")


@pytest.mark.slow
def test_lessons_are_listed_and_a_view_only_client_reads_no_other_file(
    chromium: Any, server: PageServer, folder: Path
) -> None:
    user = PanelUser(chromium, server.view_url)
    user.page.evaluate("localStorage.setItem('trundle.lesson', JSON.stringify('/etc/passwd.md'))")
    user.page.reload()
    reader = LessonUser(user, folder, {})
    reader.at("A <b>hostile</b> lesson")
    user.button("All lessons").click()
    choices = user.page.locator(".lesson .choices .b")
    choices.nth(2).wait_for()
    assert choices.all_inner_texts() == ["A <b>hostile</b> lesson", "A robot in SDF", "A car with roslaunch"]
    user.page.get_by_role("button", name="A robot in SDF").click()
    reader.at("A robot in SDF")
    reader.step.get_by_text("It starts by:").wait_for()
    assert reader.copy(reader.step.get_by_role("button", name="Copy", exact=True).first) == (
        "trundle run rp2w.world --lesson rp2w"
    )
    user.button("Close the lesson").click()
    user.button("Lessons").click()
    user.page.get_by_role("heading", name="Lessons").wait_for()
    user.close()


def _hold_w(reader: LessonUser) -> None:
    reader.page.locator(".disc").focus()
    reader.page.keyboard.down("w")
    reader.until_done()
    reader.page.keyboard.up("w")


def _insert_my_robot(user: WorldUser) -> None:
    user.side("Insert")
    entry = user.page.get_by_role("button", name="Insert my_robot", exact=True)
    entry.click()
    user.click((1.5, -1.0))


@pytest.mark.slow
def test_the_lesson_of_the_rp2w_is_done_from_its_first_step_to_its_last(chromium: Any, tmp_path: Path) -> None:
    """Drives, looks, publishes, writes the model and its plugin, inserts it, and drives it."""
    home = {
        "HOME": str(tmp_path),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}/",
    }
    words = ("run", "rp2w.world", "--lesson", "rp2w", "--port", "0")
    with running_page(*words, environment=home, folder=tmp_path) as url:
        user = WorldUser(chromium, url)
        user.look_down()
        user.side("Lesson")
        reader = LessonUser(user, tmp_path, home)
        reader.at("A robot in SDF")
        assert reader.step.get_by_text("It starts by:").count() == 0
        reader.next()

        reader.at("Drive it")
        user.until(lambda: reader.rings(".disc"), what="for the mark of the disc")
        assert reader.done == []
        _hold_w(reader)
        reader.next()

        reader.at("See through its cameras")
        assert "320" in reader.run_commands()[0]
        reader.until_done()
        reader.next()

        for title in ("Turn the camera", "Publish from a terminal"):
            reader.at(title)
            assert reader.done == []
            reader.repeat_commands()
            reader.next()

        reader.at("The model's files")
        reader.write_files()
        reader.until_done()
        reader.next()

        reader.at("Check them")
        checked = reader.run_commands()
        assert "4 links, 3 joints, 1 sensors" in checked[0]
        reader.next()

        reader.at("Insert it")
        user.until(lambda: reader.rings('[data-tab="insert"]'), what="for the mark of Insert")
        _insert_my_robot(user)
        reader.until_done()
        reader.next()

        reader.at("A plugin of your own")
        reader.write_files()
        reader.until_done()
        reader.next()

        reader.at("Drive your robot")
        user.side("World")
        user.pick("my_robot")
        user.page.keyboard.press("Delete")
        user.until(lambda: user.model("my_robot") is None, what="for the deletion")
        _insert_my_robot(user)
        user.page.get_by_role("button", name="Insert and run it").click()
        user.until(lambda: user.model("my_robot") is not None, what="for the robot with its plugin")
        _hold_w(reader)
        reader.next()

        reader.at("The same from Python")
        user.page.get_by_role("button", name="Finish").click()
        user.page.get_by_role("tab", name="Lesson").wait_for(state="detached")
        user.close()


@pytest.mark.slow
def test_the_lesson_of_the_car_is_done_from_its_first_step_to_its_last(chromium: Any, tmp_path: Path) -> None:
    """Drives the car by rostopic's command, writes a package, launches it, and drives on in the same lesson."""
    home = {"HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache")}
    home["ROS_MASTER_URI"] = f"http://127.0.0.1:{free_port()}/"
    port = ("--view-port", str(free_port()))
    with running_page(
        "launch", "smartcar", "display.launch", "--lesson", "smartcar", *port, environment=home, folder=tmp_path
    ) as url:
        user = PanelUser(chromium, url)
        reader = LessonUser(user, tmp_path, home)
        reader.at("A car with roslaunch")
        reader.next()

        reader.at("Its nodes")
        reader.until_done()
        reader.next()

        reader.at("Drive it")
        assert reader.done == []
        reader.repeat_commands()
        reader.next()

        reader.at("See it drive")
        user.page.get_by_role("tab", name="Displays").click()
        user.page.locator('aside :is(input, select)[aria-label="Fixed Frame"]').fill("odom")
        user.page.keyboard.press("Enter")
        _hold_w(reader)
        reader.next()

        reader.at("A package of your own")
        reader.write_files()
        reader.until_done()
        reader.next()

        reader.at("Expand it")
        assert "left_front_wheel_joint" in reader.run_commands()[0]
        reader.until_done()
        reader.next()

        reader.at("Its launch file")
        reader.write_files()
        reader.until_done()
        reader.next()

        reader.at("Launch it")
        command = reader.copy(reader.step.get_by_role("button", name="Copy", exact=True))
        assert command == "env ROS_PACKAGE_PATH=src trundle launch my_car display.launch --lesson smartcar"
    with running_page(
        "launch", "my_car", "display.launch", "--lesson", "smartcar", *port,
        environment={**home, "ROS_PACKAGE_PATH": "src"}, folder=tmp_path,
    ) as url:  # fmt: skip
        user.page.goto(url)
        reader.at("Launch it")  # where the other launch ended
        reader.until_done()
        reader.next()

        reader.at("Drive your car")
        reader.repeat_commands()
        reader.next()

        reader.at("With physics")
        user.close()

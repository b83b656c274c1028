"""User of a lesson, who copies its commands into a terminal and its files into files."""

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tests.page.panel_user import PanelUser

TIMEOUT_S = 120.0


class LessonUser:
    """Reads a lesson in the page of another user."""

    def __init__(self, user: PanelUser, folder: Path, environment: Mapping[str, str]) -> None:
        """Begin; `folder` and `environment` are those of the terminal."""
        self.user, self.page = user, user.page
        self.folder, self.environment = folder, environment
        self.page.context.grant_permissions(["clipboard-read", "clipboard-write"])

    @property
    def step(self) -> Any:
        return self.page.locator("article.lesson")

    def at(self, title: str) -> None:
        """Wait until a step is shown."""
        self.page.get_by_role("article", name=title, exact=True).wait_for()

    def until_done(self) -> None:
        """Wait until all checks of the step are done."""
        self.step.get_by_role("list", name="Checks").wait_for()
        self.user.until(
            lambda: self.step.locator(".checks li:not(.done)").count() == 0,
            what=f"for the checks of {self.step.get_attribute('aria-label')}",
        )

    @property
    def done(self) -> list[str]:
        """Return the checks of the step that are done."""
        return self.step.locator(".checks li.done").all_inner_texts()

    def next(self) -> None:
        """Go on from a step that is done."""
        self.page.get_by_role("button", name="Next", exact=True).click()

    def copy(self, button: Any) -> str:
        """Press a copy button; return the clipboard's text."""
        self.page.evaluate("navigator.clipboard.writeText('')")
        button.click()
        self.user.until(lambda: self.page.evaluate("navigator.clipboard.readText()") != "", what="for the copy")
        return self.page.evaluate("navigator.clipboard.readText()")

    def run_commands(self) -> list[str]:
        """Copy every command of the step into a terminal; return what they print."""
        buttons = self.step.get_by_role("button", name="Copy", exact=True)
        return [self._run(self.copy(buttons.nth(index))) for index in range(buttons.count())]

    def repeat_commands(self) -> None:
        """Run the step's commands until its checks are done: on a busy machine a program may start late."""
        while self.step.locator(".checks li:not(.done)").count() > 0:
            self.run_commands()

    def _run(self, command: str) -> str:
        done = subprocess.run(
            ["bash", "-e", "-c", command],
            cwd=self.folder,
            env={**os.environ, **self.environment, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=TIMEOUT_S,
        )
        assert done.returncode == 0, f"{command}\n{done.stdout}"
        return done.stdout

    def write_files(self) -> None:
        """Copy every file of the step to where its title says."""
        buttons = self.step.get_by_role("button", name=re.compile("^Copy .+"))
        for index in range(buttons.count()):
            title = buttons.nth(index).get_attribute("aria-label").removeprefix("Copy ")
            path = self.folder / title.replace("~", str(self.folder))
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(self.copy(buttons.nth(index)) + "\n")

    def rings(self, selector: str) -> bool:
        """Tell if a mark of the lesson lies around an element."""
        around = """selector => {
            const part = document.querySelector(selector).getBoundingClientRect();
            return [...document.querySelectorAll(".lesson-ring")].some((ring) => {
                const box = ring.getBoundingClientRect();
                return box.left <= part.left && box.right >= part.right && box.top <= part.top &&
                    box.bottom >= part.bottom && box.width < part.width + 20 && box.height < part.height + 20;
            });
        }"""
        return bool(self.page.evaluate(around, selector))

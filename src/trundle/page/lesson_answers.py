"""Answers to requests for lessons."""

import asyncio

from trundle.base.diagnostics import TrundleError, UsageError

from .lessons.checks import FileCheck
from .lessons.file_state import FileStates
from .lessons.lesson import Lesson
from .requests.answers import Answer
from .requests.lessons import (
    CheckLessonFile,
    FileState,
    LessonAction,
    LessonEntry,
    LessonList,
    ListLessons,
    OpenedLesson,
    OpenLesson,
)


class LessonAnswers:
    """Reads lessons: Trundle's own, and the file that the page was started with. Used on the loop only."""

    def __init__(self) -> None:
        self._files = FileStates()

    async def answer(self, action: LessonAction, own: str | None) -> Answer:
        """Answer a request.

        Args:
            action: request.
            own: lesson that the page was started with.

        Raises:
            TrundleError: there is no such lesson, or it cannot be read.
        """
        match action:
            case ListLessons():
                return LessonList(lessons=await asyncio.to_thread(_list, own))
            case OpenLesson(name):
                return OpenedLesson(lesson=await asyncio.to_thread(_read, name, own))
            case CheckLessonFile(name, step, check):
                lesson = await asyncio.to_thread(_read, name, own)
                return FileState(fault=await self._files.fault(_file_of(lesson, step, check)))


def _list(own: str | None) -> tuple[LessonEntry, ...]:
    from .lessons.read import lesson_names, read_lesson  # lazy: loads the parser of Markdown

    names = dict.fromkeys((*(() if own is None else (own,)), *lesson_names()))
    entries: list[LessonEntry] = []
    for name in names:
        try:
            entries.append(LessonEntry(name=name, title=read_lesson(name).title))
        except TrundleError:  # the user's file was changed; opening it reports the error
            entries.append(LessonEntry(name=name, title=name))
    return tuple(entries)


def _read(name: str, own: str | None) -> Lesson:
    """Read a lesson; of the user's files, only the one that the page was started with."""
    from .lessons.read import lesson_names, read_lesson

    if name not in (own, *lesson_names()):
        raise UsageError(f"no lesson {name!r}")
    return read_lesson(name)


def _file_of(lesson: Lesson, step: int, check: int) -> str:
    """Return the path in a check: clients name no paths."""
    try:
        found = lesson.steps[step].checks[check].check
    except IndexError:
        found = None
    if not isinstance(found, FileCheck):
        raise UsageError("the lesson's file has changed: open the lesson again")
    return found.path

"""Requests for lessons, and their answers; the server answers them itself."""

from typing import TypeAlias

from msgspec import Struct

from ..lessons.lesson import Lesson
from .answers import Answer
from .edits import Action, Name


class LessonEntry(Struct, frozen=True, kw_only=True):
    """Lesson that can be opened."""

    name: str
    title: str


class LessonList(Answer, frozen=True, kw_only=True):
    """Lessons that can be opened; the one that the page was started with is the first."""

    lessons: tuple[LessonEntry, ...]


class OpenedLesson(Answer, frozen=True, kw_only=True):
    """A lesson."""

    lesson: Lesson


class FileState(Answer, frozen=True, kw_only=True):
    """State of a file that a lesson names."""

    fault: str | None
    """Reason why the file does not load; None: it exists and loads."""


class ListLessons(Action, frozen=True, tag="lessons"):
    """List the lessons."""

    answer = LessonList


class OpenLesson(Action, frozen=True, tag="lesson"):
    """Read a lesson."""

    answer = OpenedLesson

    name: Name


class CheckLessonFile(Action, frozen=True, tag="lesson_file"):
    """Check a file that a lesson names."""

    answer = FileState

    lesson: Name
    step: int
    """Index of the step."""
    check: int
    """Index of the check in the step."""


LessonAction: TypeAlias = ListLessons | OpenLesson | CheckLessonFile

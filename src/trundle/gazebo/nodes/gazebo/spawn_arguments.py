"""Command line of gazebo_ros/spawn_model, of all distributions."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from trundle.base.diagnostics import UsageError
from trundle.spatial import Pose

Kind: TypeAlias = Literal["urdf", "sdf", "trimesh"]

_NUMBERS = {"-x": "x", "-y": "y", "-z": "z", "-R": "roll", "-P": "pitch", "-Y": "yaw"}
_KINDS: dict[str, Kind] = {"-urdf": "urdf", "-sdf": "sdf", "-gazebo": "sdf", "-trimesh": "trimesh"}
_SOURCES = ("-file", "-param", "-database", "-stdin")
_TEXTS = frozenset({*_SOURCES[:3], "-model", "-wait", "-reference_frame", "-gazebo_namespace", "-robot_namespace"})
_FLAGS = frozenset({"-stdin", "-unpause", "-package_to_model", "-b"})
_OTHERWISE = {"-namespace": "-robot_namespace", "-bond": "-b"}
"""Aliases; the first was used up to Kinetic."""
_TRIMESH = "-trimesh_"


@dataclass(slots=True)
class SpawnRequest:
    """Parsed command line of spawn_model."""

    kind: Kind | None = None
    is_old: bool = False
    """True if SDF was requested by its option before Hydro, -gazebo."""
    texts: dict[str, str] = field(default_factory=dict[str, str])
    trimesh: dict[str, str] = field(default_factory=dict[str, str])
    """Values of -trimesh_mass and its like, by the name after `trimesh_`."""
    numbers: dict[str, float] = field(default_factory=dict[str, float])
    joints: dict[str, float] = field(default_factory=dict[str, float])
    flags: set[str] = field(default_factory=set[str])

    @classmethod
    def read(cls, words: list[str]) -> "SpawnRequest":
        """Parse the command line.

        Raises:
            UsageError: an option is unknown, lacks its value or contradicts another, or the model's name is missing.
        """
        request = cls()
        rest = _parted(words)
        try:
            for word in rest:
                request._read_option(word, rest)
        except StopIteration:
            raise UsageError(f"{words[-1]} needs a value") from None
        except ValueError as error:
            raise UsageError(f"a number is needed: {error}") from None
        if "-model" not in request.texts:
            raise UsageError("-model NAME is missing")
        return request

    def _read_option(self, given: str, rest: Iterator[str]) -> None:
        word = "-" + given.lstrip("-")  # accept --x, too, which no distribution has
        word = _OTHERWISE.get(word, word)
        if word in _KINDS:
            if self.kind not in (None, _KINDS[word]):
                raise UsageError(f"{given}: the model is {self.kind} already; give one of -urdf, -sdf")
            self.kind, self.is_old = _KINDS[word], self.is_old or word == "-gazebo"
        elif word in _NUMBERS:
            self.numbers[_NUMBERS[word]] = float(next(rest))
        elif word == "-J":
            name = next(rest)
            self.joints[name] = float(next(rest))
        elif word in _TEXTS:
            self.texts[word] = next(rest)
        elif word.startswith(_TRIMESH):
            self.trimesh[word.removeprefix(_TRIMESH)] = next(rest)
        elif word in _FLAGS:
            self.flags.add(word)
        else:
            raise UsageError(f"no option {given!r}")

    @property
    def source(self) -> str:
        """Option that names the model's source.

        Raises:
            UsageError: none or several sources, or no model format.
        """
        sources = [source for source in _SOURCES if source in self.texts or source in self.flags]
        if len(sources) != 1:
            raise UsageError(f"one of {', '.join(_SOURCES)} is needed; got {' '.join(sources) or 'none'}")
        if self.kind is None and sources != ["-database"]:
            raise UsageError("one of -urdf, -sdf is needed")
        if self.kind == "trimesh" and sources != ["-file"]:
            raise UsageError("-trimesh takes the mesh from -file")
        return sources[0]

    @property
    def pose(self) -> Pose:
        """Initial pose."""
        return Pose.from_rpy(*(self.numbers.get(name, 0.0) for name in ("x", "y", "z", "roll", "pitch", "yaw")))


def _parted(words: list[str]) -> Iterator[str]:
    """Arguments, with -x=1 split in two."""
    for word in words:
        option, equals, value = word.partition("=")
        if equals and option in {*_NUMBERS, *_TEXTS}:
            yield from (option, value)
        else:
            yield word

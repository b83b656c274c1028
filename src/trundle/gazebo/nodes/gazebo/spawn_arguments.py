"""Command line of gazebo_ros/spawn_model, of all distributions."""

from collections.abc import Iterator, Sequence
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
_ALIASES = {"-namespace": "-robot_namespace", "-bond": "-b"}
"""Alias → option; -namespace exists up to Kinetic."""
_TRIMESH = "-trimesh_"


@dataclass(slots=True)
class SpawnRequest:
    """Parsed command line of spawn_model."""

    kind: Kind | None = None
    is_old: bool = False
    """True if SDF was requested with -gazebo, its option before Hydro."""
    texts: dict[str, str] = field(default_factory=dict[str, str])
    trimesh: dict[str, str] = field(default_factory=dict[str, str])
    """Values of -trimesh_mass and similar options, by the name after `trimesh_`."""
    numbers: dict[str, float] = field(default_factory=dict[str, float])
    joints: dict[str, float] = field(default_factory=dict[str, float])
    flags: set[str] = field(default_factory=set[str])

    @classmethod
    def read(cls, arguments: Sequence[str]) -> "SpawnRequest":
        """Parse the command line.

        Raises:
            UsageError: an option is unknown, lacks its value or contradicts another, or the model's name is missing.
        """
        request = cls()
        rest = _split_options(arguments)
        try:
            for argument in rest:
                request._read_option(argument, rest)
        except StopIteration:
            raise UsageError(f"{arguments[-1]} needs a value") from None
        except ValueError as error:
            raise UsageError(f"a number is needed: {error}") from None
        if "-model" not in request.texts:
            raise UsageError("-model NAME is missing")
        return request

    def _read_option(self, argument: str, rest: Iterator[str]) -> None:
        option = "-" + argument.lstrip("-")  # also accept --x, which no distribution has
        option = _ALIASES.get(option, option)
        if option in _KINDS:
            if self.kind not in (None, _KINDS[option]):
                raise UsageError(f"{argument}: the model is {self.kind} already; give one of -urdf, -sdf")
            self.kind, self.is_old = _KINDS[option], self.is_old or option == "-gazebo"
        elif option in _NUMBERS:
            self.numbers[_NUMBERS[option]] = float(next(rest))
        elif option == "-J":
            name = next(rest)
            self.joints[name] = float(next(rest))
        elif option in _TEXTS:
            self.texts[option] = next(rest)
        elif option.startswith(_TRIMESH):
            self.trimesh[option.removeprefix(_TRIMESH)] = next(rest)
        elif option in _FLAGS:
            self.flags.add(option)
        else:
            raise UsageError(f"no option {argument!r}")

    @property
    def source(self) -> str:
        """Return the option with the model's source.

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


def _split_options(arguments: Sequence[str]) -> Iterator[str]:
    """Yield the arguments, with -x=1 split in two."""
    for argument in arguments:
        option, equals, value = argument.partition("=")
        if equals and option in {*_NUMBERS, *_TEXTS}:
            yield from (option, value)
        else:
            yield argument

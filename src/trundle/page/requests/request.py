"""Requests of users; the thread that owns the simulation or the graph polls `PageServer.requests`.

They arrive as JSON; the field `request` identifies the class.
"""

import math
from typing import Annotated, Literal, TypeAlias, get_args

import msgspec

from .answers import DefinitionText, FilesExist, SavedFile
from .draft import DraftAction
from .edits import Action, EditAction
from .lessons import LessonAction
from .world import FileName, InsertAction, ModelAction, RenderModel, SaveReplay, SaveWorld

MAX_STEPS = 1_000_000
"""Limit of steps in one request."""
_MAX_TEXT = 4_000_000
Count: TypeAlias = Annotated[int, msgspec.Meta(ge=1, le=MAX_STEPS)]
TimeNs: TypeAlias = Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)]
Factor: TypeAlias = Annotated[float, msgspec.Meta(gt=0)]
Values: TypeAlias = Annotated[tuple[float, ...], msgspec.Meta(max_length=64)]
Text: TypeAlias = Annotated[str, msgspec.Meta(max_length=_MAX_TEXT)]


class Play(Action, frozen=True):
    """Run the simulation or recording."""


class Pause(Action, frozen=True):
    """Pause the simulation or recording."""


class Step(Action, frozen=True):
    """Pause, then do physics steps."""

    count: Count = 1


class RunTo(Action, frozen=True, tag="run_to"):
    """Pause, then do physics steps up to a time in the future."""

    time_ns: TimeNs


class Reset(Action, frozen=True):
    """Reset time, poses or both to their initial state."""

    what: Literal["all", "poses", "time"] = "all"


class Reload(Action, frozen=True):
    """Reload the world."""


class SetSpeed(Action, frozen=True, tag="speed"):
    """Set the speed as a multiple of real time; None: as fast as possible."""

    factor: Factor | None


class Seek(Action, frozen=True):
    """Set the time of a recorded run or bag."""

    time_ns: TimeNs


class SetReferenceOffset(Action, frozen=True, tag="reference_offset"):
    """Set the time by which the recording that the world is compared with starts after the run."""

    offset: Annotated[float, msgspec.Meta(ge=-1e6, le=1e6)]
    """[s]"""


class StopComparing(Action, frozen=True, tag="stop_comparing"):
    """Stop comparing the world with a recording."""


class Compare(Action, frozen=True, tag="compare"):
    """Compare the world with a state log that a client uploaded; the server makes this request itself."""

    file: bytes
    """Path in the system's encoding."""
    title: str


class MoveSlider(Action, frozen=True, tag="slider"):
    """Move a joint of joint_state_publisher_gui."""

    joint: str
    position: float
    """[rad or m]"""


class MoveJoystick(Action, frozen=True, tag="joystick"):
    """Set a joystick's axes, −1 to 1, and buttons, 0 or 1, in joy's order; renewed within a second, else it rests."""

    axes: Values
    buttons: Annotated[tuple[Literal[0, 1], ...], msgspec.Meta(max_length=64)]


class SaveRviz(Action, frozen=True, tag="save_rviz"):
    """Replace the .rviz file that the page was started with."""

    text: Text


class SaveRvizAs(Action, frozen=True, tag="save_rviz_as"):
    """Save an .rviz file below the folder where Trundle was started; the server executes this itself."""

    answer = SavedFile | FilesExist

    file: FileName
    text: Text
    replace: bool = False
    """True: replace an existing file."""


class Record(Action, frozen=True):
    """Start or stop recording."""

    on: bool


class PlotSeries(Action, frozen=True, tag="plot"):
    """Set the values of the simulation that are sampled for `trundle/series`; the server answers this itself."""

    series: Annotated[tuple[Annotated[str, msgspec.Meta(max_length=1000)], ...], msgspec.Meta(max_length=64)]
    """Names such as `rp2w::chassis.pose.x`."""


class Definition(Action, frozen=True):
    """Request the definition of a message type; the server answers this itself."""

    answer = DefinitionText

    type: Annotated[str, msgspec.Meta(max_length=200)]


class RenderView(Action, frozen=True, tag="camera"):
    """Draw the scene with Trundle's renderer, for browsers without WebGL; answered by `PageServer.respond_picture`.

    The camera orbits the robot or the origin: at a distance, by azimuth about z and elevation.
    """

    width: Annotated[int, msgspec.Meta(ge=16, le=1920)]
    """[px]"""
    height: Annotated[int, msgspec.Meta(ge=16, le=1200)]
    """[px]"""
    azimuth: Annotated[float, msgspec.Meta(ge=-1e6, le=1e6)] = 0.8
    """[rad]"""
    elevation: Annotated[float, msgspec.Meta(ge=-1.6, le=1.6)] = 0.5
    """[rad]"""
    distance: Annotated[float, msgspec.Meta(ge=0.01, le=1e5)] = 4.0
    """[m]"""

    def __post_init__(self) -> None:
        """Check that the numbers are finite."""
        if not all(map(math.isfinite, (self.azimuth, self.elevation, self.distance))):
            raise ValueError("a view's numbers must be finite")


ClientAction: TypeAlias = (
    Play
    | Pause
    | Step
    | RunTo
    | Reset
    | Reload
    | SetSpeed
    | Seek
    | EditAction
    | SaveWorld
    | SaveReplay
    | InsertAction
    | ModelAction
    | DraftAction
    | MoveSlider
    | MoveJoystick
    | SaveRviz
    | Record
    | SetReferenceOffset
    | StopComparing
)
"""Requests through the page's socket that its owner answers."""
SocketAction: TypeAlias = ClientAction | Definition | PlotSeries | SaveRvizAs | LessonAction
"""All requests through the page's socket."""
REQUEST_NAMES = frozenset(str(action.__struct_config__.tag) for action in get_args(SocketAction))
GraphAction: TypeAlias = MoveSlider | MoveJoystick | SaveRviz
"""Requests to nodes of the graph; all others are for the simulation or recording."""
PageAction: TypeAlias = ClientAction | RenderView | RenderModel | Compare


class Request(msgspec.Struct, frozen=True, tag=True):
    """One request; `PageServer.respond` answers it by its id."""

    id: int
    action: PageAction

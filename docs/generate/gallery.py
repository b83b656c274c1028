"""Gallery of what comes with Trundle: a picture, the command, and the sentence of `trundle run --list`."""

from pathlib import Path
from typing import NamedTuple

import trundle
from trundle.robots.packages import shipped_files

Point = tuple[float, float, float]
SIZE = (640, 400)
"""Width and height of a picture [px]."""
FILM_SIZE = (480, 300)
"""[px]"""


class Entry(NamedTuple):
    """Something to run, and its picture."""

    command: str
    """As `trundle run --list` prints it."""
    world: str
    """World of the picture."""
    eye: Point | None = None
    """Camera in the world [m]; None: a view of everything."""
    target: Point = (0.0, 0.0, 0.0)
    """[m]"""
    at_s: float = 0.0
    """Simulated time of the picture [s]."""
    robot: str = ""
    """Description of a model that the launch file spawns."""
    pose: tuple[float, ...] = (0.0, 0.0, 0.0)
    """Its pose [m, rad]."""
    joints: tuple[tuple[str, float], ...] = ()
    """Positions of its joints [rad or m]."""


GALLERY: dict[str, Entry] = {
    "living_room": Entry("trundle run rp2w_at_home.world", "rp2w_at_home.world", (2.6, -1.2, 1.9), (-0.2, 0.9, 0.7)),
    "quadruped": Entry("trundle run quadruped.world", "quadruped.world", (1.6, -1.0, 0.7), (0.45, 0.0, 0.2), 1.6),
    "house": Entry(
        "trundle launch house_navigation house.launch", "house.world", (-2.6, -5.1, 7.2), (2.8, 1.2, 0.0),
        robot="package://house_navigation/urdf/scout.urdf",
    ),
    "arm": Entry(
        "trundle launch arm_control arm.launch", "table.world", (1.8, -1.5, 1.1), (0.3, 0.0, 0.35),
        robot="package://arm_control/urdf/arm.urdf.xacro",
        joints=(("base", 0.2), ("shoulder", 0.2), ("elbow", 1.2), ("wrist", 1.4)),
    ),
    "sensor_room": Entry("trundle run sensor_room.world", "sensor_room.world", (-3.4, -3.6, 3.4), (0.0, 0.2, 0.0)),
    "smartcar": Entry(
        "trundle launch smartcar drive.launch", "living_room.world", (1.7, -0.5, 0.8), (0.5, 0.6, 0.15),
        robot="package://smartcar/urdf/smartcar.urdf.xacro", pose=(0.8, 0.4, 0.0, 0.0, 0.0, 2.0),
    ),
    "dominoes": Entry("trundle run dominoes.world", "dominoes.world", (-0.9, -2.2, 1.7), (0.1, 0.0, 0.0), 0.8),
    "race": Entry("trundle run race.world", "race.world", (3.4, -2.2, 1.5), (0.2, 0.0, 0.5), 1.4),
    "spinning_top": Entry("trundle run spinning_top.world", "spinning_top.world", (0.4, -0.4, 0.3), (0, 0, 0.1), 1.0),
    "cradle": Entry("trundle run physics/cradle.world", "physics/cradle.world", (0.2, -2.4, 1.6), (0.2, 0.0, 1.0), 0.1),
    "pendulum": Entry("trundle run physics/double_pendulum.world", "physics/double_pendulum.world", at_s=0.35),
    "stack": Entry("trundle run physics/stack.world", "physics/stack.world", (1.5, -1.3, 0.9), (0.0, 0.0, 0.5), 1.0),
    "cart_pole": Entry("trundle run cart_pole.world", "cart_pole.world", (2.0, -2.9, 1.9), (0.0, 0.0, 1.2), 0.4),
    "arm_reach": Entry("trundle run arm_reach.world", "arm_reach.world", (1.4, -1.2, 1.1), (0.3, 0.0, 0.2)),
    "drive_to_goal": Entry("trundle run drive_to_goal.world", "drive_to_goal.world", (-3.2, -3.4, 3.0)),
    "willowgarage": Entry(
        "trundle run willowgarage.world", "willowgarage.world", (-22.0, -34.0, 32.0), (4.0, 2.0, 0.0)
    ),
}  # fmt: skip
"""Name of the picture → what it shows."""
_PAGE = """# Gallery

All of this comes with Trundle; `trundle run --list` has more, with the models that a world of yours may include.
Each command opens the page in the browser; with `--headless` it runs without.

<div style="display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1.2rem" markdown>
{cards}
</div>

## Run it many times

Plans of [sweeps](howto/sweep.md) come with it, too:

{plans}
"""
_CARD = """<div markdown>
{shown}

{about}

`{command}`
</div>
"""


FILMS = {"dominoes": 6.0, "quadruped": 4.0, "spinning_top": 4.0, "cart_pole": 2.0}
"""Entry of the gallery → duration of its film [s], from time zero."""


def page() -> str:
    """Return the gallery in Markdown."""
    files = shipped_files()
    abouts = {file.command: file.about for file in files}
    cards = [
        _CARD.format(shown=_shown(name, abouts[entry.command]), about=abouts[entry.command], command=entry.command)
        for name, entry in GALLERY.items()
    ]
    plans = [f"- `{file.command}`: {file.about}" for file in files if file.kind == "plans"]
    return _PAGE.format(cards="\n".join(cards), plans="\n".join(plans))


def _shown(name: str, about: str) -> str:
    file = f"pictures/gallery_{name}"
    if name in FILMS:
        return (
            f'<p><video src="{file}.mp4" poster="{file}.png" autoplay loop muted playsinline width="100%"></video></p>'
        )
    return f"![{about}]({file}.png)"


def draw_all(folder: Path) -> dict[str, Path]:
    """Render missing pictures; `make clean` removes existing ones."""
    folder.mkdir(parents=True, exist_ok=True)
    files = {f"gallery_{name}.png": (entry, 0.0) for name, entry in GALLERY.items()}
    files |= {f"gallery_{name}.mp4": (GALLERY[name], duration_s) for name, duration_s in FILMS.items()}
    for name, (entry, duration_s) in files.items():
        if not (folder / name).exists():
            draw(entry, folder / name, film_s=duration_s)
    return {name: folder / name for name in files}


def draw(entry: Entry, to: Path, *, film_s: float = 0.0) -> None:
    """Render a picture, or a film; leave no partial file."""
    from PIL import Image

    part = to.with_name(f"part_{to.name}")
    view = {"eye": entry.eye, "target": entry.target if entry.eye else None}
    with trundle.load(entry.world, plugins=True, warn=False) as sim:
        if entry.robot:
            with trundle.load(entry.robot, warn=False) as alone:
                model = alone.models[0].model
            robot = sim.spawn(model)
            robot.set_pose(entry.pose)
            for joint, position in entry.joints:
                robot.joint(joint).set_position(position)
        if film_s:
            with sim.film(part, size=FILM_SIZE, **view):
                sim.run(film_s)
        else:
            if entry.at_s:
                sim.run(entry.at_s)
            Image.fromarray(sim.picture(size=SIZE, **view).rgb).save(part)
    part.rename(to)

"""Small worlds for tests of surfaces."""

from pathlib import Path

import trundle
from trundle.sim.simulation import Simulation

G = 9.8


def load_models(folder: Path, *models: str, gravity: float = G) -> Simulation:
    """A world of these models."""
    file = folder / "w.world"
    file.write_text(
        f'<sdf version="1.7"><world name="w"><gravity>0 0 {-gravity}</gravity>{"".join(models)}</world></sdf>'
    )
    return trundle.load(str(file))


def friction(mu: float, mu2: float | None = None, inside: str = "", torsional: str = "") -> str:
    mu2 = mu if mu2 is None else mu2
    return f"<friction><ode><mu>{mu}</mu><mu2>{mu2}</mu2>{inside}</ode>{torsional}</friction>"


def body(
    name: str,
    shape: str,
    surface: str = "",
    *,
    pose: str = "0 0 0 0 0 0",
    mass: float = 1.0,
    link: str = "",
    model: str = "",
    static: bool = False,
) -> str:
    moments = "".join(f"<{m}>{0.01 * mass}</{m}>" for m in ("ixx", "iyy", "izz"))
    return (
        f'<model name="{name}"><static>{static}</static><pose>{pose}</pose>{model}<link name="l">{link}'
        f"<inertial><mass>{mass}</mass><inertia>{moments}<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>"
        f'<collision name="c"><geometry>{shape}</geometry><surface>{surface}</surface></collision></link></model>'
    )


def floor(surface: str = "", *, tilt: float = 0.0) -> str:
    plane = "<plane><normal>0 0 1</normal><size>100 100</size></plane>"
    return body("floor", plane, surface, static=True, pose=f"0 0 0 0 {tilt} 0")


BLOCK = "<box><size>0.4 0.4 0.1</size></box>"
BALL = "<sphere><radius>0.1</radius></sphere>"

"""Names of a simulation's page."""

from pathlib import Path

from trundle.robots.model import World

from .manifest import find_robot


def page_names(world: World) -> tuple[str, str | None]:
    """Title of the page, and name of the robot; most worlds are called `default`, which says less than their file."""
    robot = find_robot(world)
    name = None if robot is None else robot.name
    file = Path(world.at.file)
    if world.name != "default":
        return world.name, name
    return file.stem if file.suffix == ".world" else name or world.name, name

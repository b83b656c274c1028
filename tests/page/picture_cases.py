"""All cases of the comparison with rviz, and their view."""

from dataclasses import replace

from tests.page.picture_case import Case
from tests.page.picture_cases_clouds import CLOUDS
from tests.page.picture_cases_markers import MARKERS
from tests.page.picture_cases_poses import POSES
from tests.page.picture_cases_scene import SCENE

VIEW = {
    "Class": "rviz/Orbit",
    "Distance": 8,
    "Focal Point": {"X": 0, "Y": 0, "Z": 0.5},
    "Yaw": 0.6,
    "Pitch": 0.5,
    "Near Clip Distance": 0.01,
    "Target Frame": "<Fixed Frame>",
    "Value": "Orbit (rviz)",
}
REMAPPINGS = {"/renamed": "/scan"}
"""Remappings of the rviz node, for names in all files."""
_LINES = ("Grid", "PoseArray", "Path", "Polygon")
"""Cases of lines a pixel wide, which the page smooths at rest and rviz does not."""
_LINE_GRAIN = 3
ALONE = [
    replace(case, grain=_LINE_GRAIN) if case.name in _LINES else case for case in (*SCENE, *MARKERS, *POSES, *CLOUDS)
]


def _scene(name: str, *names: str) -> Case:
    """Return one case with the displays of several."""
    displays = [{**case.display, "Enabled": True, "Value": True} for case in ALONE if case.name in names]
    assert len(displays) == len(names)
    return Case(name=name, display={"Class": "rviz/Group", "Name": "All", "Displays": displays})


TOGETHER = [
    _scene("Scene", "Grid", "Map", "RobotModel", "LaserScan as Flat Squares", "Path of billboards", "PoseArray"),
    _scene(
        "Scene of clouds", "Grid", "TF", "PointCloud2 of many as Spheres", "PointCloud2 by height", "LaserScan as Boxes"
    ),
    _scene(
        "Scene of markers",
        "Grid",
        "Marker arrow",
        "Marker colored lines",
        "Marker textured mesh",
        "Marker cubes",
        "InteractiveMarkers of axes and a turn",
    ),
]
CASES = [*ALONE, *TOGETHER]

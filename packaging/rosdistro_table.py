"""Writes src/trundle/robots/repositories/rosdistro.tsv from a clone of the published rosdistro index.

python packaging/rosdistro_table.py FOLDER: the folder has noetic/distribution.yaml, etc. (REP 143).
"""

import sys
from pathlib import Path

import yaml

from trundle.robots.repositories import ROSDISTROS, read_distribution, write_table

TABLE = Path(__file__).parents[1] / "src/trundle/robots/repositories/rosdistro.tsv"


def main(folder: Path) -> None:
    """Write the table of the distributions of ROS 1."""
    entries = []
    for distro in ROSDISTROS:
        text = (folder / distro / "distribution.yaml").read_text()
        entries += read_distribution(yaml.load(text, yaml.CSafeLoader), distro)
    TABLE.write_text(write_table(entries))


if __name__ == "__main__":
    main(Path(sys.argv[1]))

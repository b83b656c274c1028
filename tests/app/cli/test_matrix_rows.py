"""The matrix has a row for each subcommand."""

import argparse
import importlib

import pytest
from tests.app.cli.matrix import ROWS

REFUSED = {"encrypt", "decrypt"}
"""Subcommands of rosbag that are not supported."""


@pytest.mark.parametrize("command", ["topic", "node", "param", "service", "msg", "srv", "bag", "tf", "pack"])
def test_every_subcommand_is_in_the_matrix(command: str) -> None:
    parser = argparse.ArgumentParser()
    importlib.import_module(f"trundle.app.cli.{command}").configure(parser)
    (choices,) = (action.choices for action in parser._actions if isinstance(action.choices, dict))
    names = {id(choice): name for name, choice in reversed(choices.items())}.values()  # aliases count once

    assert set(names) - REFUSED == {row.trundle.split()[1] for row in ROWS if row.trundle.startswith(f"{command} ")}


@pytest.mark.parametrize("command", ["log", "graph", "plot", "exec"])
def test_a_command_without_subcommands_is_in_the_matrix(command: str) -> None:
    assert any(row.trundle.split()[:1] == [command] for row in ROWS)

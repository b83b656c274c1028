"""Loading of launch files; `ROSLaunchConfig` at its old path."""

from collections.abc import Sequence
from typing import Any

from rosgraph.network import create_local_xmlrpc_uri
from trundle.ros import NOETIC

from .contents import ROSLaunchConfig as ROSLaunchConfig, namespaces_of as namespaces_of
from .core import Param, RLException
from .node import Node
from .xmlloader import XmlLoader, XmlParseException


def load_config_default(
    roslaunch_files: Sequence[Any],
    port: int | None,
    roslaunch_strs: Sequence[str] | None = None,
    loader: Any = None,
    verbose: bool = False,
    assign_machines: bool = True,
    ignore_unset_args: bool = False,
) -> ROSLaunchConfig:
    """Contents of launch files, with the core's node and parameters.

    Args:
        roslaunch_files: paths, or pairs of a path and its arguments ('name:=value').
        port: master's port; None or 0: the environment's master.
        roslaunch_strs: XML texts, read after the files.
        loader: XmlLoader to use.
        verbose: print each added item.
        assign_machines: set each node's machine.
        ignore_unset_args: accept arguments without a value.

    Raises:
        RLException: a file is invalid.
    """
    config = ROSLaunchConfig()
    if port:
        config.master.uri = create_local_xmlrpc_uri(port)
    loader = loader or XmlLoader()
    loader.ignore_unset_args = ignore_unset_args
    load_roscore(loader, config, verbose)
    for file in roslaunch_files:
        path, arguments = file if isinstance(file, tuple) else (file, None)
        loader.load(path, config, argv=arguments, verbose=verbose)
    for text in roslaunch_strs or ():
        try:
            loader.load_string(text, config, verbose=verbose)
        except XmlParseException as error:
            raise RLException(f"Launch string: {text}\nException: {error}") from None
    if assign_machines:
        config.assign_machines()
    return config


def load_roscore(loader: Any, config: ROSLaunchConfig, verbose: bool = True) -> None:
    """Add the master's own node and parameters."""
    del loader
    for key, value in (("/rosversion", NOETIC.version), ("/rosdistro", NOETIC.distro)):
        config.add_param(Param(key, f"{value}\n"), verbose=verbose)
    config.add_node(Node("rosout", "rosout", name="rosout"), core=True, verbose=verbose)

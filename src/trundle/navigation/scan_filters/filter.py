"""Base of the filters of a chain."""

from typing import Any, ClassVar

import msgspec

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from ..settings import read_settings, reconfigure
from .scan import Scan


class ScanFilter:
    """A filter of laser_filters; its parameters are the fields of its `Settings`."""

    Settings: ClassVar[type[msgspec.Struct]]
    required: ClassVar[tuple[str, ...]] = ()
    """Parameters without a default."""
    is_reconfigurable: ClassVar[bool] = True
    """True if dynamic_reconfigure changes the parameters."""

    def __init__(self, name: str, parameters: RosParameters, node: Node, buffer: TransformBuffer) -> None:
        """Read the parameters.

        Args:
            name: filter's name in the chain.
            parameters: its `params`.
            node: node of the chain.
            buffer: transforms.

        Raises:
            ParamError: a parameter is missing or invalid.
        """
        for required in self.required:
            if required not in parameters:
                parameters.text(required)  # raises ParamError: the parameter is not set
        self.settings: Any = read_settings(self.Settings, parameters)
        self.fault = ""
        """Reason why the last scan could not be filtered."""
        self.name = name
        self._buffer = buffer
        if self.is_reconfigurable:
            reconfigure(node, f"~{name}", self.settings, lambda: None)

    def apply(self, scan: Scan) -> bool:
        """Filter a scan in place; False: it cannot be filtered, `fault` says why."""
        raise NotImplementedError

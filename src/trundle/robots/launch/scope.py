"""Scope in a launch file: namespace, arguments, remappings, environment, ~params."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeAlias

from trundle.base.diagnostics import Source
from trundle.robots.names import canonical_name, join_names

from .plan import ParamCommand, ParamValue

PrivateParam: TypeAlias = tuple[ParamValue | ParamCommand, Source]


@dataclass(slots=True, kw_only=True)
class Scope:
    """Scope of a launch file, group or node element.

    A child copies its parent's settings, so that settings in a group end with it.
    """

    namespace: str
    """Global; the root is '/'."""
    file: str
    """Path of the launch file, for messages."""
    arguments: dict[str, str] = field(default_factory=dict[str, str])
    declared: set[str] = field(default_factory=set[str])
    """Arguments declared so far in this file, set or not."""
    lenient_arguments: bool = False
    """True if included with pass_all_args: arguments may be declared twice, and fixed ones override passed ones."""
    remappings: dict[str, str] = field(default_factory=dict[str, str])
    env: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    private_params: dict[str, PrivateParam] = field(default_factory=dict[str, PrivateParam])
    """~params of the nodes that follow."""
    anonymous: dict[str, str] = field(default_factory=dict[str, str])
    """Results of `$(anon x)` in this file."""

    def child(self, namespace: str | None = None) -> "Scope":
        """Create a child scope in the same file, optionally in another namespace."""
        return Scope(
            namespace=self.join(namespace) if namespace else self.namespace,
            file=self.file,
            arguments=dict(self.arguments),
            declared=set(self.declared),
            lenient_arguments=self.lenient_arguments,
            remappings=dict(self.remappings),
            env=list(self.env),
            private_params=dict(self.private_params),
            anonymous=dict(self.anonymous),
        )

    def included(self, namespace: str | None, file: str, arguments: Iterable[tuple[str, str]]) -> "Scope":
        """Create the scope of an included file, with only the passed arguments."""
        scope = self.child(namespace)
        scope.file = file
        if self.private_params:  # as in roslaunch, ~params set in the file apply after it if any were set before
            scope.private_params = self.private_params
        scope.arguments = dict(arguments)
        scope.declared = set()
        scope.lenient_arguments = False
        scope.anonymous = {}
        return scope

    def join(self, name: str) -> str:
        """Resolve a name to a global one."""
        return canonical_name(join_names(self.namespace, name)) or "/"

    def remap(self, source: str, target: str) -> None:
        """Remap for the nodes that follow; a repeated source moves to the end."""
        self.remappings.pop(source, None)
        self.remappings[source] = target

    def set_private_param(self, name: str, value: PrivateParam) -> None:
        """Set a ~param for the nodes that follow; a repeated name moves to the end."""
        self.private_params.pop(name, None)
        self.private_params[name] = value

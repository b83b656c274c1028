"""What is in force at one place of a launch file: namespace, arguments, remappings, environment, ~params."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeAlias

from trundle.diagnostics import Source
from trundle.names import canonical_name, join_names

from .plan import ParamCommand, ParamValue

PrivateParam: TypeAlias = tuple[ParamValue | ParamCommand, Source]


@dataclass(slots=True, kw_only=True)
class Scope:
    """One launch file, group or node element while it is read.

    A child starts with copies of its parent's settings, so that nothing set in a group is seen behind it.
    """

    namespace: str
    """Global; the root is '/'."""
    file: str
    """The launch file, as messages call it."""
    arguments: dict[str, str] = field(default_factory=dict[str, str])
    declared: set[str] = field(default_factory=set[str])
    """Arguments that this file has declared so far, set or not."""
    lenient_arguments: bool = False
    """Included with pass_all_args: arguments may be declared twice and fixed ones override what was passed."""
    remappings: dict[str, str] = field(default_factory=dict[str, str])
    env: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    private_params: dict[str, PrivateParam] = field(default_factory=dict[str, PrivateParam])
    """For every node that follows."""
    anonymous: dict[str, str] = field(default_factory=dict[str, str])
    """What `$(anon x)` became in this file."""

    def child(self, namespace: str | None = None) -> "Scope":
        """Open a scope within this file, in another namespace where one is given."""
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
        """Open the scope of an included file, which sees no argument but those it is passed."""
        scope = self.child(namespace)
        scope.file = file
        if (
            self.private_params
        ):  # as roslaunch has it: ~params that the file sets are seen behind it, if any were before
            scope.private_params = self.private_params
        scope.arguments = dict(arguments)
        scope.declared = set()
        scope.lenient_arguments = False
        scope.anonymous = {}
        return scope

    def join(self, name: str) -> str:
        """Make a name global."""
        return canonical_name(join_names(self.namespace, name)) or "/"

    def remap(self, source: str, target: str) -> None:
        """Remap for the nodes that follow; a later one of the same source wins and goes last."""
        self.remappings.pop(source, None)
        self.remappings[source] = target

    def set_private_param(self, name: str, value: PrivateParam) -> None:
        """Set a ~param for the nodes that follow; a later one of the same name goes last."""
        self.private_params.pop(name, None)
        self.private_params[name] = value

"""State of a simulation in expressions: `models.rp2w.links.chassis.z`, `models["a b"].joints.c.position`."""

import math
from collections import ChainMap
from collections.abc import Mapping
from dataclasses import fields

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.base.expressions import MATH_NAMES, PYTHON_NAMES, Budget, Interpreter
from trundle.sim.simulation import JointHandle, LinkHandle, ModelHandle, Simulation
from trundle.spatial import NS_PER_S, Pose, Twist
from trundle.studies.plan_files.variation import Value

from .plan import Formula
from .topics import NoMessageError, SilentTopic, TopicReader

_POSE = ("x", "y", "z", "roll", "pitch", "yaw")
_TWIST = ("vx", "vy", "vz", "wx", "wy", "wz")
_MODEL = (*_POSE, *_TWIST, "speed", "links", "joints")
_LINK = (*_POSE, *_TWIST, "speed")
_FUNCTIONS: dict[str, object] = {**MATH_NAMES, **PYTHON_NAMES}
_JOINT = ("position", "velocity", "effort")


class _Handles(dict[str, object]):
    """Models, links or joints by name."""


class StateExpressions:
    """Evaluator of a plan's expressions over a simulation's state."""

    def __init__(self) -> None:
        self._interpreter = Interpreter(dotted=_dotted)

    def evaluate(self, formula: Formula, names: Mapping[str, object]) -> object:
        """Evaluate an expression.

        Raises:
            UsageError: evaluation failed, with its line and the reason.
        """
        self._interpreter.budget = Budget()
        try:
            return self._interpreter.evaluate(formula.text, ChainMap(dict(names), _FUNCTIONS))
        except NoMessageError:
            raise
        except Exception as error:  # any error of Python, such as ZeroDivisionError
            raise UsageError(f"{formula.at}: error: {formula.text}: {error}") from None

    def number(self, formula: Formula, names: Mapping[str, object]) -> float:
        """Evaluate an expression as a finite number.

        Raises:
            UsageError: the value is not a finite number.
        """
        value = self.evaluate(formula, names)
        if not isinstance(value, int | float) or not math.isfinite(value):
            raise UsageError(f"{formula.at}: error: {formula.text} must be a finite number, and is {value!r}")
        return float(value)


def named_values(values: Mapping[str, Value]) -> dict[str, object]:
    """Return a row's values that expressions can name: those varied by an element path (with `/`) have no such name."""
    return {name: value for name, value in values.items() if "/" not in name}


def state_names(simulation: Simulation, values: Mapping[str, Value], topics: TopicReader | None) -> dict[str, object]:
    """Return the names in expressions: `models`, `topics`, the time `t` [s], and the row's values."""
    models = _Handles((model.name, model) for model in simulation.models)
    names = {**named_values(values), "models": models, "t": simulation.time_ns / NS_PER_S}
    return names if topics is None else {**names, "topics": topics.messages()}


def _dotted(owner: object, name: str) -> object:
    """Return an attribute of a part of the world; NotImplemented for other values."""
    match owner:
        case _Handles():
            if name in owner:
                return owner[name]
            raise AttributeError(f"there is no {name!r}; there are: {', '.join(owner) or 'none'}")
        case ModelHandle():
            if name == "links":
                return _Handles((link.name, link) for link in owner.links)
            if name == "joints":
                return _Handles((joint.name, joint) for joint in owner.joints)
            return _state(owner, name, _MODEL)
        case LinkHandle():
            return _state(owner, name, _LINK)
        case JointHandle():
            if name not in _JOINT:
                raise AttributeError(f"a joint has no {name!r}; it has: {', '.join(_JOINT)}")
            return float(getattr(owner, name))
        case SilentTopic():
            raise NoMessageError(f"no message on {owner.topic} yet")
        case _ if hasattr(owner, "__msgtype__"):
            return _field(owner, name)
        case _:
            return NotImplemented


def _field(message: object, name: str) -> object:
    """Return a field of a ROS message."""
    names = [field.name for field in fields(message)]  # pyright: ignore[reportArgumentType]
    if name not in names:
        raise AttributeError(f"the message has no {name!r}; it has: {', '.join(names)}")
    value = getattr(message, name)
    return value.tolist() if isinstance(value, np.ndarray) else value


def _state(owner: ModelHandle | LinkHandle, name: str, names: tuple[str, ...]) -> float:
    if name in _POSE:
        return _component(owner.pose, name)
    if name == "speed":
        return math.hypot(*owner.twist.linear)
    if name in _TWIST:
        twist: Twist = owner.twist
        return float((*twist.linear, *twist.angular)[_TWIST.index(name)])
    kind = "model" if isinstance(owner, ModelHandle) else "link"
    raise AttributeError(f"a {kind} has no {name!r}; it has: {', '.join(names)}")


def _component(pose: Pose, name: str) -> float:
    return pose.position[_POSE.index(name)] if name in "xyz" else pose.rpy[_POSE.index(name) - 3]

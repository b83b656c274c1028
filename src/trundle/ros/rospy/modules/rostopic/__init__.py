"""Topics of the graph: types, classes, fields by path."""

import sys
import time
from collections.abc import Callable
from typing import Any

import rosgraph
from genpy.message import get_message_class, strify_message as strify_message

from .statistics import ROSTopicBandwidth as ROSTopicBandwidth, ROSTopicHz as ROSTopicHz

NAME = "rostopic"


class ROSTopicException(Exception):
    """Base class."""


class ROSTopicIOException(ROSTopicException):
    """The master does not respond."""


_Evaluate = Callable[[Any], Any]


def msgevalgen(pattern: str) -> _Evaluate | None:
    """Function that returns a message's field by path: '/pose/position/x', '/ranges[0]', '/ranges[1:3]'."""
    steps: list[tuple[str, int | slice | None]] = []
    for part in filter(None, pattern.split("/")):
        name, bracket, index = part.partition("[")
        try:
            steps.append((name, _index(index) if bracket else None))
        except ValueError as error:
            print(f"field '{name}' has invalid slice argument '{index}': {error}", file=sys.stderr)
            return None
    return (lambda message: _evaluated(message, steps, pattern)) if steps else None


def create_field_filter(echo_nostr: bool, echo_noarr: bool) -> Callable[[Any], list[str]]:
    """Function for `strify_message` that returns the fields of a message to be shown.

    Args:
        echo_nostr: omit strings.
        echo_noarr: omit arrays.
    """
    omitted = [mark for mark, is_omitted in (("string", echo_nostr), ("[", echo_noarr)) if is_omitted]

    def field_names(message: Any) -> list[str]:
        pairs = zip(message.__slots__, message._slot_types, strict=True)
        return [name for name, kind in pairs if not any(mark in kind for mark in omitted)]

    return field_names


def _index(text: str) -> int | slice:
    if not text.endswith("]"):
        raise ValueError("missing closing ']'")
    parts = [int(part) if part else None for part in text[:-1].split(":")]
    if len(parts) == 1 and parts[0] is not None:
        return parts[0]
    if not 2 <= len(parts) <= 3:
        raise ValueError("not an index or slice")
    return slice(*parts)


def _evaluated(message: Any, steps: list[tuple[str, int | slice | None]], pattern: str) -> Any:
    for number, (name, index) in enumerate(steps):
        if not hasattr(message, name):
            print(f"no field named {name} in {pattern}", file=sys.stderr)
            return None
        message = getattr(message, name)
        if index is None:
            continue
        try:
            message = message[index]
        except IndexError as error:
            print(f"{error}: {pattern}", file=sys.stderr)
            return None
        if isinstance(message, list):
            return [_evaluated(item, steps[number + 1 :], pattern) for item in message]
    return message


def get_topic_type(topic: str, blocking: bool = False) -> tuple[str | None, str | None, _Evaluate | None]:
    """Type and name of a topic, and the function that returns the field if `topic` names one.

    Args:
        topic: global name, possibly followed by a field's path.
        blocking: wait until there is such a topic.

    Raises:
        ROSTopicIOException: the master does not answer.
    """
    result = _find_type(topic)
    if result[0] is None and blocking:
        sys.stderr.write(f"WARNING: topic [{topic}] does not appear to be published yet\n")
    while result[0] is None and blocking and not _is_shutdown():
        time.sleep(0.1)
        result = _find_type(topic)
    return result


def get_topic_class(topic: str, blocking: bool = False) -> tuple[Any, str | None, _Evaluate | None]:
    """Class and name of a topic, and the function that returns the field if `topic` names one.

    Raises:
        ROSTopicException: the class is unknown.
    """
    type_name, name, evaluate = get_topic_type(topic, blocking)
    if type_name is None:
        return None, None, None
    message_class = get_message_class(type_name)
    if message_class is None:
        raise ROSTopicException(f"Cannot load message class for [{type_name}]. Are your messages built?")
    return message_class, name, evaluate


def find_by_type(topic_type: str) -> list[str]:
    """Topics of a type."""
    return [topic for topic, kind in _topic_types() if kind == topic_type]


def get_topic_list(master: Any = None) -> tuple[list[tuple[str, str, list[str]]], list[tuple[str, str, list[str]]]]:
    """Published and subscribed topics: (name, type, nodes)."""
    master = master or rosgraph.Master(f"/{NAME}")
    types = dict(master.getTopicTypes())
    pubs, subs, _ = master.getSystemState()

    def typed(topics: Any) -> list[tuple[str, str, list[str]]]:
        return [(topic, types.get(topic, "unknown type"), nodes) for topic, nodes in topics]

    return typed(pubs), typed(subs)


def get_api(master: Any, caller_id: str) -> str | None:
    """URI of a node's API; None for an unknown node."""
    try:
        return master.lookupNode(caller_id)
    except rosgraph.MasterException:
        return None


def create_publisher(topic_name: str, topic_type: str, latch: bool, disable_rostime: bool = True) -> tuple[Any, Any]:
    """Publisher of a topic, and the class of its messages; starts a node.

    Raises:
        ROSTopicException: the class is unknown.
    """
    import rospy

    message_class = get_message_class(topic_type)
    if message_class is None:
        raise ROSTopicException(f"invalid message type: {topic_type}")
    rospy.init_node(NAME, anonymous=True, disable_rosout=True, disable_rostime=disable_rostime)
    return rospy.Publisher(topic_name, message_class, latch=latch, queue_size=100), message_class


def _find_type(topic: str) -> tuple[str | None, str | None, _Evaluate | None]:
    types = _topic_types()
    exact = [(name, kind) for name, kind in types if name == topic]
    prefixes = [(name, kind) for name, kind in types if topic.startswith(f"{name}/")]
    for name, kind in exact or sorted(prefixes, reverse=True):
        if kind != "*" and (name == topic or _has_field(kind, topic[len(name) + 1 :])):
            return kind, name, msgevalgen(topic[len(name) :])
    return None, None, None


def _has_field(type_name: str, path: str) -> bool:
    message_class = get_message_class(type_name)
    value = None if message_class is None else message_class()
    for part in path.partition("[")[0].rstrip("/").split("/"):
        if value is not None and part:
            if not hasattr(value, part):
                return False
            value = getattr(value, part)
    return True


def _topic_types() -> list[tuple[str, str]]:
    try:
        return [(topic, kind) for topic, kind in rosgraph.Master(f"/{NAME}").getTopicTypes()]
    except OSError:
        raise ROSTopicIOException("Unable to communicate with master!") from None


def _is_shutdown() -> bool:
    import rospy

    return rospy.is_shutdown()


def rostopicmain(argv: list[str] | None = None) -> None:
    """Run the command rostopic with its arguments; default: this process's arguments.

    Raises:
        SystemExit: it failed.
    """
    from trundle.app.cli.main import main

    if (code := main(["topic", *(sys.argv if argv is None else argv)[1:]])) != 0:
        sys.exit(code)

"""Node that observes the nodes of a graph, sends them messages and requests, and prints the observations as JSON.

    python tests/data/compared_runs/observer.py PROCESS_ID START_S

Waits until the graph has been unchanged for a while, then records the first messages of every topic, publishes a
default message three times on topics that are only subscribed to, and calls every service with a default request.
"""

import json
import sys
import threading
import time

import rosgraph
import roslib.message
import rospy
import rosservice

_LOGGERS = ("/get_loggers", "/set_logger_level")
_QUIET = ("/rosout", "/rosout_agg", "/clock", "/statistics")
_OTHERS = {"/observer", "/rosout", "/turtlesim"}
_SETTLED_S = 2.0
_RESPONSE_S = 10.0
_FIRST, _LONG = 3, 10_000
"""Messages recorded of a topic, and characters of each."""
master = rosgraph.Master("/observer")
messages = {}


def graph():
    """Publishers, subscribers and services of the observed nodes: pairs (name, type)."""
    state = master.getSystemState()
    types = dict(master.getTopicTypes())
    return [sorted((name, types.get(name, "")) for name, nodes in kind if set(nodes) - _OTHERS) for kind in state]


def message_class(type_name):
    """Class of a type; None if it is unknown, or any type (*)."""
    return roslib.message.get_message_class(type_name) if "/" in type_name else None


def record(topic, type_name):
    """Record the first messages of a topic."""
    cls = message_class(type_name)
    recorded = messages.setdefault(topic, [])

    def append(message):
        if len(recorded) < _FIRST:
            recorded.append(str(message)[:_LONG])

    return rospy.Subscriber(topic, cls, append) if cls else None


def has_ended(process):
    """True if a process has ended, or is a zombie."""
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def wait_settled(process, end):
    """Wait until a node's endpoints stay unchanged; False at the end, or if its process has ended."""
    previous, since = None, time.time()
    while time.time() < end:
        now = graph()
        if now != previous:
            previous, since = now, time.time()
        if any(now) and time.time() - since > _SETTLED_S:
            return True
        if has_ended(process):
            return False
        time.sleep(0.1)
    return False


def send(topics):
    """Publish a default message on each topic, three times."""
    classes = {topic: message_class(type_name) for topic, type_name in topics}
    publishers = {topic: rospy.Publisher(topic, cls, queue_size=9) for topic, cls in classes.items() if cls}
    time.sleep(1)
    for _ in range(_FIRST):
        for topic, publisher in publishers.items():
            publisher.publish(classes[topic]())
        time.sleep(0.3)


def response(name):
    """Response of a service to a default request, in a list; an empty list after a timeout."""
    cls = rosservice.get_service_class_by_name(name)
    responses = []

    def call():
        try:
            responses.append(str(rospy.ServiceProxy(name, cls)()))
        except rospy.ServiceException as error:
            responses.append(f"ServiceException: {error}")

    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    thread.join(_RESPONSE_S)
    return list(responses)


rospy.init_node("observer", disable_rosout=True)
has_settled = wait_settled(sys.argv[1], time.time() + float(sys.argv[2]))
publishers, subscribers, services = graph()
responses = {}
if has_settled:
    published = {topic for topic, _ in publishers}
    recording = [record(*pair) for pair in publishers if pair[0] not in _QUIET]
    time.sleep(_SETTLED_S)
    send([pair for pair in subscribers if pair[0] not in published and pair[0] not in _QUIET])
    names = [name for name, _ in services if not name.endswith(_LOGGERS)]
    responses = {name: response(name) for name in names}
    time.sleep(_SETTLED_S)
print(
    json.dumps(
        {
            "has_settled": has_settled,
            "publishers": publishers,
            "subscribers": subscribers,
            "services": [name for name, _ in services],
            "parameters": sorted(master.getParamNames()),
            "messages": messages,
            "responses": responses,
        }
    )
)

"""rosapi's services."""

import json

import pytest
from tests.gazebo.nodes.bridge_client import connected, port_of

STRING = "std_msgs/String"


@pytest.fixture
def api(graph):
    """Call a service of rosapi as a web page does."""
    graph.start("rosapi/rosapi_node", name="rosapi")
    graph.start("rosbridge_server/rosbridge_websocket", port=0, services_glob="[/nothing]")
    graph.loop.run(graph.client.wait_for_service("/rosapi/get_time", 60.0))
    with connected(port_of(graph, "rosbridge_websocket")) as client:
        yield lambda service, /, **fields: client.call(f"/rosapi/{service}", fields)


def test_topics_and_nodes_are_listed(graph, api) -> None:
    graph.client.advertise("/chatter", STRING)
    graph.client.subscribe("/subscribed", STRING, print)
    graph.client.advertise_service("/serve", "std_srvs/Empty", lambda _: {})
    for name in ("goal", "cancel", "status", "feedback", "result"):
        graph.client.advertise(f"/move/{name}", STRING)
    graph.loop.run(graph.client.wait_registered())
    topics = api("topics")
    full = api("topics_and_raw_types")

    assert dict(zip(topics["topics"], topics["types"], strict=True))["/chatter"] == STRING
    assert full["typedefs_full_text"][full["topics"].index("/chatter")].strip() == "string data"
    assert set(api("topics_for_type", type=STRING)["topics"]) >= {"/chatter", "/subscribed"}
    assert api("topic_type", topic="/chatter") == {"type": STRING}
    assert api("topic_type", topic="/none") == {"type": ""}
    assert api("publishers", topic="/chatter") == {"publishers": ["/client"]}
    assert api("subscribers", topic="/subscribed") == {"subscribers": ["/client"]}
    assert api("action_servers") == {"action_servers": ["/move"]}
    assert set(api("nodes")["nodes"]) >= {"/client", "/rosapi", "/rosbridge_websocket"}
    details = api("node_details", node="/client")
    assert "/chatter" in details["publishing"]
    assert "/subscribed" in details["subscribing"]
    assert "/serve" in details["services"]


def test_services_are_listed(graph, api) -> None:
    graph.client.advertise_service("/serve", "std_srvs/Empty", lambda _: {})
    graph.loop.run(graph.client.wait_registered())

    assert "/serve" in api("services")["services"]
    assert api("services_for_type", type="std_srvs/Empty") == {"services": ["/serve"]}
    assert api("service_type", service="/serve") == {"type": "std_srvs/Empty"}
    assert api("service_type", service="/none") == {"type": ""}
    assert api("service_providers", service="std_srvs/Empty") == {"providers": ["/client"]}
    assert api("service_node", service="/serve") == {"node": "/client"}
    assert api("service_host", service="/serve")["host"]


def test_message_and_service_types_are_described(api) -> None:
    joy, header, time = api("message_details", type="sensor_msgs/Joy")["typedefs"]
    (request,) = api("service_request_details", type="std_srvs/SetBool")["typedefs"]
    (response,) = api("service_response_details", type="std_srvs/SetBool")["typedefs"]
    status = api("message_details", type="sensor_msgs/NavSatStatus")["typedefs"][0]

    assert joy == {
        "type": "sensor_msgs/Joy", "fieldnames": ["header", "axes", "buttons"],
        "fieldtypes": ["std_msgs/Header", "float32", "int32"], "fieldarraylen": [-1, 0, 0],
        "examples": ["{}", "[]", "[]"], "constnames": [], "constvalues": [],
    }  # fmt: skip
    assert (header["examples"], header["fieldtypes"]) == (["0", "{}", ""], ["uint32", "time", "string"])
    assert (time["type"], time["fieldnames"]) == ("time", ["secs", "nsecs"])
    assert (request["type"], request["examples"]) == ("std_srvs/SetBoolRequest", ["False"])
    assert response["fieldnames"] == ["success", "message"]
    assert dict(zip(status["constnames"], status["constvalues"], strict=True))["STATUS_NO_FIX"] == "-1"


def test_parameters_are_json(graph, api) -> None:
    api("set_param", name="/a/b", value=json.dumps([1, "x"]))

    assert graph.loop.run(graph.client.params.get("/a/b")) == [1, "x"]
    assert json.loads(api("get_param", name="/a")["value"]) == {"b": [1, "x"]}
    assert json.loads(api("get_param", name="/none", default="[2]")["value"]) == [2]
    assert api("get_param", name="/none") == {"value": "null"}
    assert api("has_param", name="/a/b") == {"exists": True}
    assert api("search_param", name="a") == {"global_name": "/a"}
    assert api("search_param", name="none") == {"global_name": ""}
    assert "/a/b" in api("get_param_names")["names"]
    api("delete_param", name="/a/b")
    assert api("has_param", name="/a/b") == {"exists": False}
    assert api("get_time")["time"]["secs"] > 1e9


def test_globs_hide_topics_and_parameters(graph) -> None:
    graph.start("rosapi/rosapi_node", name="rosapi", topics_glob="[/open*]", params_glob="[/open*]")
    graph.client.advertise("/open", STRING)
    graph.client.advertise("/closed", STRING)
    graph.loop.run(graph.client.wait_registered())
    graph.set_params({"/closed": 1, "/open_too": 2})

    assert list(graph.call("/rosapi/topics", "rosapi/Topics").topics) == ["/open"]
    assert list(graph.call("/rosapi/get_param_names", "rosapi/GetParamNames").names) == ["/open_too"]
    graph.call("/rosapi/set_param", "rosapi/SetParam", name="/closed", value="3")
    assert graph.loop.run(graph.client.params.get("/closed")) == 1

"""Messages between the server and its owner."""

import io

import msgspec
import pytest

from trundle.page import MoveJoint, PageAction, Play, Request, Reset, SetSpeed, Step
from trundle.page.requests.answers import Inserted
from trundle.page.wire import (
    Driven,
    Respond,
    encode_json,
    frame,
    from_server_decoder,
    read_frame,
    to_server_decoder,
)


@pytest.mark.parametrize(
    "message",
    [
        Request(3, Play()),
        Request(2**40, MoveJoint(model="arm", joint="elbow", position=0.5)),
        Driven({"/cmd_vel": "geometry_msgs/Twist"}),
    ],
)
def test_messages_survive_encoding_and_decoding(message: Request | Driven) -> None:
    pipe = io.BytesIO(frame(message) * 2)

    assert [from_server_decoder.decode(read_frame(pipe)) for _ in range(2)] == [message] * 2


def test_file_names_that_are_not_utf_8_are_sent_with_question_marks() -> None:
    answer = encode_json(Inserted(name="cart\udcff"))
    decoded = to_server_decoder.decode(read_frame(io.BytesIO(frame(Respond(1, "no \udcff", answer=answer)))))

    assert decoded == Respond(1, "no ?", answer=b'{"name":"cart?"}')
    assert encode_json({"source": ("/\udcff/a.sdf:3", None)}) == b'{"source":["/?/a.sdf:3",null]}'


@pytest.mark.parametrize("size", [0, 3, 4, 10])
def test_the_end_of_a_pipe_within_a_message_raises(size: int) -> None:
    with pytest.raises(EOFError):
        read_frame(io.BytesIO(frame(Request(3, Play()))[:size]))


@pytest.mark.parametrize(
    ("text", "action"),
    [
        ('{"request": "play"}', Play()),
        ('{"request": "step", "count": 5, "more": 1}', Step(5)),
        ('{"request": "reset"}', Reset("all")),
        ('{"request": "speed", "factor": null}', SetSpeed(None)),
    ],
)
def test_requests_are_decoded_by_their_name(text: str, action: PageAction) -> None:
    assert msgspec.json.decode(text, type=PageAction) == action


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('{"request": "dance"}', "Invalid value 'dance'"),
        ('{"request": "step", "count": 0}', "`int` >= 1"),
        ('{"request": "speed", "factor": -1}', "> 0"),
        ('{"request": "joint", "model": "a", "joint": "b"}', "give one of 'position', 'velocity' and 'effort'"),
        ('{"request": "joint", "model": "a", "joint": "b", "position": 1, "velocity": 1}', "give one of"),
        ('{"request": "seek", "time_ns": -1}', ">= 0"),
        (f'{{"request": "joystick", "axes": [], "buttons": [{10**30}]}}', "buttons"),
    ],
)
def test_invalid_requests_are_refused_with_a_reason(text: str, reason: str) -> None:
    with pytest.raises(msgspec.ValidationError) as caught:
        msgspec.json.decode(text, type=PageAction)

    assert reason in str(caught.value)

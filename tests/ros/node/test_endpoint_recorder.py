"""Records of endpoints within records."""

from trundle.ros.node.endpoint_recorder import EndpointRecorder


class FakeEndpoint:
    """An endpoint."""

    def unregister(self) -> None:
        """Nothing to do."""


def test_an_outer_record_includes_the_endpoints_of_an_inner_one() -> None:
    recorder = EndpointRecorder()
    before, within, after = FakeEndpoint(), FakeEndpoint(), FakeEndpoint()

    with recorder.record() as outer:
        recorder.add(before)
        with recorder.record() as inner:
            recorder.add(within)
        recorder.add(after)
    recorder.add(FakeEndpoint())

    assert inner == [within]
    assert outer == [before, within, after]

"""Ten thousand broken messages: the server answers, prints no traceback and uses no more memory."""

import random
from pathlib import Path

import pytest
from fuzz.catalog import load_target
from fuzz.connection import SEPARATOR
from fuzz.mutate import Pool, mutate
from tests.graphs import running_graph
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = pytest.mark.slow
MESSAGES = 10_000
GROWTH_BYTES = 40_000_000


def _resident_bytes(page: PageServer) -> int:
    status = Path(f"/proc/{page.process_id}/status").read_text()
    return 1024 * int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1])


def _wait_for_answer(page: PageServer, client: ProtocolClient, number: str) -> None:
    """Wait until the server has handled all messages so far."""
    for request in page.requests():
        page.respond(request.id)
    client.send("trundle/request", id=number, request="definition", type="std_msgs/String")
    client.until(lambda: any(message.get("id") == number for message in client.jsons))
    client.jsons.clear()


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="needs /proc")
@pytest.mark.parametrize("seed", range(2))
def test_the_server_survives_ten_thousand_broken_messages(
    seed: int, capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # where .rviz files are saved
    source = random.Random(seed)
    target = load_target("foxglove")
    pool = Pool(target.words, target.seeds())
    with running_graph() as graph:
        node = graph.node("ours")
        node.advertise("/chat", "std_msgs/String")
        node.advertise_service("/set", "std_srvs/SetBool", lambda r: {"success": r.data})
        graph.ready(node)
        address = GraphAddress(master_uri=graph.core.uri)
        with PageServer.start(
            Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address, source=tmp_path
        ) as page:
            sizes: list[int] = []
            for _ in range(4):
                with ProtocolClient(page.url) as client:
                    client.until(lambda client=client: "/set" in client.services)
                    for number in range(MESSAGES // 4):
                        message = source.choice(mutate(source.choice(pool.inputs), pool, source).split(SEPARATOR))
                        client.socket.send(message, text=message[:1] >= b" ")
                        if number % 50 == 0:
                            _wait_for_answer(page, client, str(number))
                sizes.append(_resident_bytes(page))
            assert page.alive
            assert sizes[-1] - sizes[0] < GROWTH_BYTES, sizes
    errors = capfd.readouterr().err
    assert "Traceback" not in errors, errors[-5000:]

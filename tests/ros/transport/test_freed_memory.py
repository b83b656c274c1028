"""Memory of long messages: kept by the process for the next ones."""

import platform
import subprocess
import sys

import pytest

_COUNT = """
import resource
from trundle.ros import _message_codec

def faults():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    for _ in range(20):
        messages = [bytes(300_000) for _ in range(8)]
        del messages
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before

first = faults()
_message_codec.keep_freed_memory(8_000_000)
_message_codec.keep_freed_memory(1)
faults()
print(first, faults())
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="glibc's malloc only")
def test_memory_of_long_messages_is_used_again_without_page_faults() -> None:
    """A smaller request does not undo a larger one. The 20 rounds use some 590 pages each, of 8 messages."""
    done = subprocess.run([sys.executable, "-c", _COUNT], capture_output=True, text=True, check=True)
    before, after = map(int, done.stdout.split())
    assert before > 20 * 100
    assert after < 100

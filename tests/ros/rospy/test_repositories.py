"""Nodes of other repositories print, publish, respond and end as with Debian's rospy.

TRUNDLE_ROSPY_REPOSITORIES names checked-out repositories; without it, the test's own programs show that the comparison
works.
"""

from pathlib import Path

import pytest
from tests.ros.rospy.compared_runs import REPOSITORIES, Repository, compare, find_programs
from tests.ros.rospy.original_messages import generate

pytestmark = [
    pytest.mark.slow,
    pytest.mark.real_ros,
    pytest.mark.skipif(not Path("/usr/lib/python3/dist-packages/rospy").is_dir(), reason="no rospy is installed"),
]
_PROGRAMS = {name: (folder, path) for folder in REPOSITORIES for name, path in find_programs(folder).items()}
_TALKER = """#!/usr/bin/env python3
import rospy
from talking.msg import Said
from talking.srv import Repeat

rospy.init_node("talker", anonymous=True)
publisher = rospy.Publisher("said", Said, queue_size=1, latch=True)
subscriber = rospy.Subscriber("heard", Said, lambda message: print("heard", repr(message.words)))
service = rospy.Service("repeat", Repeat, lambda request: [WORDS])
publisher.publish(WORDS)
print("started at", rospy.get_time())
rospy.spin()
"""


@pytest.fixture(scope="module")
def repositories(tmp_path_factory: pytest.TempPathFactory) -> dict[Path, Repository]:
    repositories = {folder: Repository(folder, tmp_path_factory.mktemp("generated")) for folder in REPOSITORIES}
    for repository in repositories.values():
        generate(repository.packages, repository.generated)
    return repositories


@pytest.mark.skipif(not _PROGRAMS, reason="TRUNDLE_ROSPY_REPOSITORIES names no repositories")
@pytest.mark.parametrize("name", _PROGRAMS)
def test_nodes_of_repositories_behave_as_with_the_original(repositories: dict[Path, Repository], name: str) -> None:
    folder, program = _PROGRAMS[name]
    verdict = compare(repositories[folder], program)
    if verdict.startswith("not comparable"):
        pytest.skip(verdict)
    assert verdict == "same"


@pytest.mark.parametrize(
    ("words", "differences"),
    [
        ('"a word"', set[str]()),
        (
            'rospy.__file__.split("/")[1] == "usr" and "one" or "other"',
            {
                'messages: -   "words: \\"one\\""',
                'messages: +   "words: \\"other\\""',
                'values: -   "words: \\"one\\""',
                'values: +   "words: \\"other\\""',
                'responses: -   "words: \\"one\\""',
                'responses: +   "words: \\"other\\""',
            },
        ),
    ],
)
def test_differences_in_messages_and_service_responses_are_found(
    tmp_path: Path, words: str, differences: set[str]
) -> None:
    package = tmp_path / "repository/talking"
    for name, text in {
        "package.xml": "<package><name>talking</name></package>",
        "msg/Said.msg": "string words\n",
        "srv/Repeat.srv": "---\nstring words\n",
        "scripts/talker.py": _TALKER.replace("WORDS", words),
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    repository = Repository(package.parent, tmp_path / "generated")
    generate(repository.packages, repository.generated)
    verdict, *lines = compare(repository, package / "scripts/talker.py").splitlines()
    assert verdict == ("different" if differences else "same")
    assert set(lines) == differences

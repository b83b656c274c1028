"""catkin_make run_tests: tests of a package are compiled and run, and their results are written."""

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from tests.ros.sdk.conftest import require_compiler

pytestmark = pytest.mark.slow

_CMAKE = """\
cmake_minimum_required(VERSION 3.0.2)
project(tested)
find_package(catkin REQUIRED COMPONENTS roscpp roslib)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
if(CATKIN_ENABLE_TESTING)
  catkin_add_gtest(sums test/sums.cpp)
  target_link_libraries(sums ${catkin_LIBRARIES})
  catkin_add_nosetests(test/test_words.py)
  add_executable(helper EXCLUDE_FROM_ALL test/helper.cpp)
  add_rostest(test/helped.test DEPENDENCIES helper)
  add_library(part test/part.cpp)
endif()
"""
_SUMS = """\
#include <gtest/gtest.h>
#include <ros/package.h>
#include <ros/time.h>
TEST(Sums, durationsAdd) { EXPECT_EQ(ros::Duration(3), ros::Duration(1) + ros::Duration(2)); }
TEST(Sums, packagesOfTheWorkspaceAreFound) { EXPECT_NE("", ros::package::getPath("tested")); }
TEST(Sums, wrong) { EXPECT_EQ(5, 2 + 2); }
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
"""
_WORDS = """\
import pathlib
import unittest
class Words(unittest.TestCase):
    def test_a_library_for_tests_is_built_before(self):
        self.assertTrue((pathlib.Path(__file__).parents[3] / "devel/lib/libpart.so").exists())

    def test_upper(self):
        self.assertEqual("a".upper(), "A")
"""


def test_tests_run_and_a_failed_one_is_in_the_results(tmp_path: Path) -> None:
    require_compiler()
    if not Path("/usr/include/gtest/gtest.h").exists():
        pytest.skip("this machine has no GoogleTest for C++")
    package = tmp_path / "src/tested"
    (package / "test").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>tested</name><version>0.1.0</version></package>")
    (package / "CMakeLists.txt").write_text(_CMAKE)
    (package / "test/sums.cpp").write_text(_SUMS)
    (package / "test/part.cpp").write_text("int part() { return 1; }\n")
    (package / "test/helper.cpp").write_text("int main() {}\n")
    (package / "test/helped.test").write_text("<launch/>")
    (package / "test/test_words.py").write_text(_WORDS)
    environment = {name: value for name, value in os.environ.items() if name != "CMAKE_PREFIX_PATH"}

    def make(*targets: str) -> "subprocess.CompletedProcess[str]":
        command = [sys.executable, "-m", "trundle", "--as", "catkin_make", *targets]
        env = {**environment, "PWD": str(tmp_path)}
        return subprocess.run(command, cwd=tmp_path, env=env, capture_output=True, text=True, check=False)

    built = make()
    assert built.returncode == 0, built.stdout + built.stderr
    assert "program helper (test/helper.cpp; src/tested/CMakeLists.txt:10): not in this build" in built.stdout
    done = make("run_tests")
    output = done.stdout + done.stderr

    results = ET.parse(tmp_path / "build/tested/test_results/tested/gtest-sums.xml").getroot()
    assert (results.get("tests"), results.get("failures")) == ("3", "1"), output
    assert re.search(r"Ran 2 tests.*\n\nOK", output), output
    assert (tmp_path / "devel/lib/tested/sums").exists()
    assert (tmp_path / "devel/lib/tested/helper").exists(), "a rostest needs it"

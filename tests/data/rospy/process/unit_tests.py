import contextlib
import io
import os
import tempfile
import unittest
import xml.etree.ElementTree

import rosunit

PATH = "results.xml"
ARGUMENTS = ["program", f"--gtest_output=xml:{PATH}"]
os.chdir(tempfile.mkdtemp())


class Sums(unittest.TestCase):
    def test_right(self):
        print("printed within a test")
        self.assertEqual(1 + 1, 2)

    def test_wrong(self):
        self.assertEqual(1 + 1, 3, "<sum>")

    def test_error(self):
        raise KeyError("none")


class Passing(unittest.TestCase):
    def test_only(self):
        self.assertTrue(True)


rosunit.unitrun("sums", "passing", Passing, ARGUMENTS)
print([case.attrib.get("name") for case in xml.etree.ElementTree.parse(PATH).getroot()])
with contextlib.redirect_stdout(io.StringIO()) as out:
    try:
        rosunit.unitrun("sums", "sums", Sums, ARGUMENTS)
    except SystemExit as end:
        print("[exit]", end.code)
print([line for line in out.getvalue().splitlines() if line.startswith(("[", " *", "ERROR", "FAILURE", "SUMMARY", "-"))])
root = xml.etree.ElementTree.parse(PATH).getroot()
print({name: value for name, value in sorted(root.attrib.items()) if name != "time"})
for case in root:
    print(case.tag, case.attrib.get("name"), [(each.tag, each.attrib["type"]) for each in case])
print("printed within a test" in root.find("system-out").text)
os.remove(PATH)
print(rosunit.rostest_name_from_path("/a/pkg", "/a/pkg/test/one.test"), rosunit.XML_OUTPUT_FLAG)

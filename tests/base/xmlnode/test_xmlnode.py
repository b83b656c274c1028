"""XML tree: lines, unread elements, and hostile text."""

import pytest
from lxml import etree

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.base.xmlnode import parse_xml


def test_lines_count_blank_lines_before_the_declaration() -> None:
    """Blank lines before <?xml …?> are common in tutorials, and Gazebo accepts them."""
    node = parse_xml("\n\n<?xml version='1.0'?>\n<a>\n<b/></a>", name="x.xml")

    assert node.children[0].at == Source("x.xml", 5)


def test_unread_elements_and_attributes_are_reported_once() -> None:
    node = parse_xml("<a known='1' odd='2'>\n<b/>\n<c/>\n<c/></a>", name="x.xml")
    node.attribute("known")
    node.find("b")
    report = Diagnostics()

    node.report_unread(report)

    assert report.warnings == [
        "x.xml:3: warning: <c> in <a> is not supported; it is ignored",
        "x.xml:1: warning: attribute 'odd' of <a> is not supported; it is ignored",
    ]


def test_a_second_element_of_a_single_one_is_reported() -> None:
    """The first is used, as in Gazebo; a second <ixx> may have been meant as <iyy>."""
    report = Diagnostics()
    node = parse_xml("<inertia><ixx>1</ixx><link/><link/>\n<ixx>2</ixx><ixx>3</ixx></inertia>", name="x.sdf")

    assert node.number("ixx", default=0.0) == 1.0
    assert len(node.all("link")) == 2
    node.report_unread(report)

    assert report.warnings == ["x.sdf:2: warning: a second <ixx> in <inertia>; the first one is used"]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "x.xml:1: error: the file is empty"),
        ("hello", "x.xml:1: error: not well-formed XML: the root element must start here, with '<' (column 1)"),
        ("<a>\n<b></a>", "x.xml:2: error: not well-formed XML: </a> does not match <b> of line 2 (column 8)"),
        (" \n  <a>\n<b></a>", "x.xml:3: error: not well-formed XML: </a> does not match <b> of line 3 (column 8)"),
        ("\n  <a b></a>", "x.xml:2: error: not well-formed XML: attribute 'b' has no value (column 7)"),
        ("<a>\n<b c='1' c='2'/></a>", "x.xml:2: error: not well-formed XML: duplicate attribute 'c' (column 15)"),
        ("<a>&nbsp;</a>", "x.xml:1: error: not well-formed XML: &nbsp; is not defined; XML has &amp; "),
        ("<a>\n<b>", "x.xml:2: error: not well-formed XML: <b> of line 2 is not closed (column 4)"),
        ("<a><b:c/></a>", "the prefix 'b' is not declared; xmlns:b="),
        ("<a>" * 100_000, "x.xml:1: error: not well-formed XML: elements nested more than 256 deep"),
        ('<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><a>&x;</a>', "&x; is not defined"),
    ],
)
def test_invalid_documents_are_reported_in_one_line(text: str, sentence: str) -> None:
    with pytest.raises(DescriptionError) as error:
        parse_xml(text, name="x.xml")

    assert sentence in str(error.value)


@pytest.mark.parametrize(
    "text",
    [
        "<a>& b</a>",
        "<a>&b</a>",
        "<a>< b</a>",
        "<a><1/></a>",
        "<a b=c/>",
        "<a b='c/>",
        "<a b='<'/>",
        "<a b='1'c='2'/>",
        "<a b='1' <c/></a>",
        "<a><!-- -- --></a>",
        "<a><!-- ",
        "<a>]]></a>",
        "<a><![CDATA[</a>",
        "<a>\x08</a>",
        "<a>&#0;</a>",
        "<a>&#xZZ;</a>",
        "<a/><b/>",
        "<a></a",
        "<a><?b </a>",
        "<!-- --><?xml version='1.0'?><a/>",
        "<?xml version='1.0'><a/>",
        "<?xml version='1.0' encoding='klingon'?><a/>",
        "<a:/>",
        "<!DOCTYPE a [<a/>",
    ],
)
def test_no_message_is_libxml2s(text: str) -> None:
    with pytest.raises(etree.XMLSyntaxError) as original:
        etree.fromstring(text.encode())
    with pytest.raises(
        DescriptionError, match=r": error: not well-formed XML: .{8,} \(column \d+\) \[malformed-xml\]$"
    ) as error:
        parse_xml(text, name="x.xml")

    assert (original.value.msg or "").partition(", line")[0] not in error.value.what


def test_a_lone_surrogate_is_refused() -> None:
    """JSON can contain one, as in a state log's header."""
    with pytest.raises(DescriptionError, match="log:1: error: "):
        parse_xml("<\ud800 a='1'/>", name="log", report=Diagnostics())


def test_an_entity_bomb_is_refused() -> None:
    entities = "".join(f'<!ENTITY e{i + 1} "{f"&e{i};" * 10}">' for i in range(12))

    with pytest.raises(DescriptionError, match="not well-formed XML"):
        parse_xml(f'<!DOCTYPE a [<!ENTITY e0 "x">{entities}]><a>&e12;</a>', name="x.xml")


@pytest.mark.parametrize(("text", "value"), [("nan", 7.0), ("1e400", 7.0), ("two", 7.0), (" 2.5 ", 2.5)])
def test_invalid_or_infinite_numbers_become_the_default(text: str, value: float) -> None:
    node = parse_xml(f"<a><n>{text}</n></a>", name="x.xml")

    assert node.number("n", default=7.0) == value


def test_integers_may_be_hexadecimal() -> None:
    report = Diagnostics()
    node = parse_xml("<contact><collide_bitmask>0x0F</collide_bitmask></contact>", name="w.sdf", report=report)
    assert node.integer("collide_bitmask", default=1) == 15
    assert not report.findings


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ('<a><gz::b c::d="1">2</gz::b></a>', '<a><gz::b c::d="1">2</gz::b></a>'),
        ('<a><x:b y:c="1"/></a>', '<a><x:b y:c="1"/></a>'),
        ("<a>x &amp; y & z &no;</a>", "<a>x &amp; y  z no;</a>"),
        ('<a b="x<y"c=1 d=\'"\'/>', '<a b="x&lt;y" c="1" d="&quot;"/>'),
        ("<a>1\x012</a>", "<a>12</a>"),
        ("<a>]]></a>", "<a>]]&gt;</a>"),
        ("<!-- -- --><?xml version='1.0'>\n<a/>", "<a/>"),
        ("<a/></b> & < more", "<a/>"),
        ('<?xml version="1.0" encoding="utf-8"?><a>\xe9</a>', "<a>\xe9</a>"),
        ("<a><1/><!ODD><b/></a>", "<a><b/></a>"),
    ],
)
def test_xml_that_tinyxml_accepts_is_read_with_a_warning(text: str, read: str) -> None:
    """Gazebo 11's libsdformat and urdfdom 3 parse with TinyXML 2.6; each case was compared with it."""
    report = Diagnostics()

    assert parse_xml(text.encode("latin-1"), name="x.sdf", report=report).xml() == read
    (warning,) = report.warnings
    assert "warning: not well-formed XML: " in warning
    assert warning.endswith("; read as Gazebo reads it")
    with pytest.raises(DescriptionError, match="not well-formed XML"):
        parse_xml(text.encode("latin-1"), name="x.sdf")


@pytest.mark.parametrize(
    "text",
    [
        '<a b="1" b="2"/>',
        "<a b/>",
        "<a></ a>",
        "<a>< b></b></a>",
        "<a><:b>1</:b></a>",
        '<a b="1>2</a>',
        "<a><b></a>",
        "<a>\0</a>",
        "words <a/>",
        '<!DOCTYPE a [<!ENTITY x "y">]><a>&x; & &z;</a>',
    ],
)
def test_xml_that_tinyxml_refuses_is_refused(text: str) -> None:
    with pytest.raises(DescriptionError, match="not well-formed XML"):
        parse_xml(text, name="x.sdf", report=Diagnostics())


def test_lines_are_kept_in_rewritten_xml() -> None:
    text = "\n<?xml version='1.0'?>\n<!-- a\n-- b -->\n<a x='1\n2' y = 3>\n&\n<![CDATA[\n]]><b::c\n/>\n<d/></a>"
    node = parse_xml(text, name="x.sdf", report=Diagnostics())

    assert [(child.tag, child.at.line) for child in node.children] == [("b::c", 10), ("d", 11)]


def test_utf_16_is_read_with_a_warning() -> None:
    report = Diagnostics()

    assert parse_xml("<a>1</a>".encode("utf-16"), name="x.sdf", report=report).text == "1"
    assert report.warnings == ["x.sdf:1: warning: UTF-16 text, which Gazebo and urdfdom refuse; save it as UTF-8"]


def test_a_message_is_one_line_even_if_it_quotes_several() -> None:
    report = Diagnostics()

    parse_xml("<!--\n two\n -- lines --><a/>", name="x.sdf", report=report)

    (warning,) = report.warnings
    assert "\n" not in warning

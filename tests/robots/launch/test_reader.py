"""Launch files become plans by roslaunch's rules."""

from collections.abc import Mapping
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.launch import LaunchPlan, ParamCommand, read_launch, read_launch_text


class Folders:
    """Package finder over a mapping of names to folders."""

    def __init__(self, folders: Mapping[str, Path] | None = None, *, is_lenient: bool = False) -> None:
        self._folders = dict(folders or {})
        self.is_lenient = is_lenient

    def find_folder(self, name: str, /) -> Path | None:
        return self._folders.get(name)

    def absent_package(self, _file: Path, /) -> str | None:
        return None

    def not_found_message(self, name: str, /) -> str:
        return f"no package {name!r}"


def plan_of(
    body: str, *, report: Diagnostics | None = None, packages: Folders | None = None, **arguments: str
) -> LaunchPlan:
    return read_launch_text(
        f"<launch>{body}</launch>",
        name="t.launch",
        packages=packages or Folders(),
        report=report or Diagnostics(),
        arguments=arguments,
        env={"HOME": "/home/u", "ROBOT": "rover"},
    )


def params_of(body: str, **arguments: str) -> dict[str, object]:
    plan = plan_of(body, report=None, packages=None, **arguments)
    return {param.name: param.value for param in plan.params}


NODE = '<node pkg="p" type="t" name="n"/>'


def test_a_nodes_attributes_arrive_in_the_plan() -> None:
    (node,) = plan_of(
        '<node pkg="p" type="t" name="n" ns="a/b" args="-x 1" output="screen" respawn="true" respawn_delay="2.5"'
        ' cwd="node" launch-prefix="nice"><remap from="x" to="y"/><env name="E" value="1"/></node>'
    ).nodes
    assert node.full_name == "/a/b/n"
    assert (node.package, node.type, node.arguments, node.output) == ("p", "t", "-x 1", "screen")
    assert (node.respawn, node.respawn_delay_s, node.cwd, node.launch_prefix) == (True, 2.5, "node", "nice")
    assert node.remappings == (("x", "y"),)
    assert node.env == (("E", "1"),)
    assert str(node.at) == "t.launch:1"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("1.0", 1.0),
        ("true", True),
        ("True", True),
        ("1e3", "1e3"),
        ("0x10", "0x10"),
        ("on", "on"),
        ("", ""),
        ("1_000", "1_000"),
        (" 5 ", 5),
        ("nan", "nan"),
        ("007", 7),
    ],
)
def test_a_value_without_type_is_typed_as_roslaunch_does(text: str, value: object) -> None:
    got = params_of(f'<param name="a" value="{text}"/>')["/a"]
    assert got == value
    assert type(got) is type(value)


def test_the_variables_of_a_sourced_ros_are_there() -> None:
    body = '<param name="a" value="$(env ROS_DISTRO)"/><param name="b" value="$(optenv ROS_VERSION 2)"/>'
    assert params_of(body) == {"/a": "noetic", "/b": 1}
    plan = read_launch_text(
        f"<launch>{body}</launch>",
        name="t.launch",
        packages=Folders(),
        report=Diagnostics(),
        env={"ROS_DISTRO": "kinetic"},
    )
    assert plan.params[0].value == "kinetic"


def test_named_types_are_kept() -> None:
    body = '<param name="j" type="str" value="1"/><param name="k" type="double" value="3"/>'
    body += '<param name="l" type="yaml" value="[1, {a: b}]"/>'
    assert params_of(body) == {"/j": "1", "/k": 3.0, "/l": [1, {"a": "b"}]}


def test_a_private_param_goes_to_every_later_node_of_its_scope() -> None:
    plan = plan_of(
        '<node pkg="p" type="t" name="before"/><group ns="g"><param name="~a" value="1"/>'
        '<node pkg="p" type="t" name="n"/><node pkg="p" type="t" name="m"><param name="a" value="2"/></node></group>'
        '<node pkg="p" type="t" name="behind"/>'
    )
    assert {p.name: p.value for p in plan.params} == {"/g/n/a": 1, "/g/m/a": 2}


def test_a_remapping_holds_for_later_nodes_and_the_last_one_wins() -> None:
    plan = plan_of(f'<remap from="a" to="b"/><remap from="c" to="d"/><remap from="a" to="e"/>{NODE}')
    assert plan.nodes[0].remappings == (("c", "d"), ("a", "e"))


def test_settings_of_a_group_end_with_it() -> None:
    plan = plan_of(f'<group ns="g"><env name="E" value="1"/><remap from="a" to="b"/></group>{NODE}')
    assert plan.nodes[0].env == ()
    assert plan.nodes[0].remappings == ()


def test_rosparam_yaml_is_unrolled_and_knows_angles() -> None:
    values = params_of("<rosparam>\n  a: deg(180)\n  b: {c: rad(pi/2), d: !degrees 90}\n  e: [1, 2]\n</rosparam>")
    assert values["/a"] == pytest.approx(3.141592653589793)
    assert values["/b/c"] == pytest.approx(1.5707963267948966)
    assert values["/b/d"] == pytest.approx(1.5707963267948966)
    assert values["/e"] == [1, 2]


def test_rosparam_below_a_node_is_the_nodes_own() -> None:
    body = '<node pkg="p" type="t" name="n"><rosparam param="x">[1]</rosparam><rosparam>{y: 2}</rosparam></node>'
    assert params_of(body) == {"/n/x": [1], "/n/y": 2}


def test_steps_and_cleared_namespaces_are_kept_in_order() -> None:
    plan = plan_of(
        '<group ns="g" clear_params="true"><rosparam command="delete" param="a"/></group>'
        '<rosparam command="dump" file="/tmp/x.yaml"/>'
    )
    assert plan.clear_params == ("/g",)
    assert [(s.command, s.name, s.file) for s in plan.steps] == [("delete", "/g/a", ""), ("dump", "/", "/tmp/x.yaml")]


def test_if_and_unless_decide_about_an_element() -> None:
    body = '<arg name="on" default="true"/><param name="a" value="1" if="$(arg on)"/>'
    body += '<param name="b" value="1" unless="$(arg on)"/>'
    assert params_of(body) == {"/a": 1}
    assert params_of(body, on="0") == {"/b": 1}


def test_arguments_default_and_override() -> None:
    body = '<arg name="a" default="1"/><arg name="b" value="$(arg a)2"/><param name="p" value="$(arg b)"/>'
    assert params_of(body) == {"/p": 12}
    assert params_of(body, a="7") == {"/p": 72}
    with pytest.raises(DescriptionError, match="argument 'b' has a fixed value, '12'; it cannot be set"):
        params_of(body, b="1")


def test_substitutions_know_environment_and_folder() -> None:
    values = params_of(
        '<param name="a" value="$(env ROBOT)/x"/><param name="b" value="$(optenv NONE two words)"/>'
        '<param name="c" value="$(dirname)"/><param name="d" value="cost: $5 (a)"/>'
    )
    assert values == {"/a": "rover/x", "/b": "two words", "/c": str(Path.cwd()), "/d": "cost: $5 (a)"}


def test_an_anonymous_name_is_the_same_within_a_file() -> None:
    values = params_of('<param name="a" value="$(anon n)"/><param name="b" value="$(anon n)"/>')
    assert values["/a"] == values["/b"]
    assert str(values["/a"]).startswith("n_")


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("arg('v') * 2", 1.0),
        ("v + 0.5", 1.0),
        ("'abc' + str(1)", "abc1"),
        ("env('HOME') != ''", True),
        ("optenv('ZZ', 'q')", "q"),
        ("pi", 3.141592653589793),
        ("'a' if v > 1 and not true else 'b'", "b"),
        ("'x,y'.split(',')[1]", "y"),
        ("int(sqrt(16))", 4),
        ("','.join([str(x * v) for x in [1, 2]])", "0.5,1.0"),
        ("f'{v:.2f} m'", "0.50 m"),
    ],
)
def test_eval_supports_the_expressions_of_launch_files(expression: str, value: object) -> None:
    body = f'<arg name="v" default="0.5"/><param name="a" value="$(eval {expression})"/>'
    body = body.replace("> 1", "&gt; 1")
    assert params_of(body)["/a"] == value


@pytest.mark.parametrize(
    "expression",
    [
        "().__class__",
        "__import__('os').getcwd()",
        "1 +",
        "nobody",
        "'{0.real}'.format(1)",
        "9**9**9",
        "'a' * 10**9",
        "[x for x in 1]",
        "(x := 1)",
        "pi()",
        "1/0",
        "-" * 5000 + "1",
    ],
)
def test_eval_refuses_everything_else_in_a_sentence(expression: str) -> None:
    with pytest.raises(DescriptionError, match=r"t\.launch:1: error: \$\(eval "):
        params_of(f'<param name="a" value="$(eval {expression})"/>')


def test_find_gives_a_packages_folder_and_xacro_needs_none(tmp_path: Path) -> None:
    plan = plan_of(
        '<arg name="urdf" default="$(find xacro)/xacro.py \'$(find car)/car.urdf.xacro\'"/>'
        '<param name="robot_description" command="$(arg urdf)"/>',
        packages=Folders({"car": tmp_path}),
    )
    command = plan.params[0].value
    assert isinstance(command, ParamCommand)
    assert command.line == f"xacro/xacro.py '{tmp_path}/car.urdf.xacro'"


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("$(find car)params/x.yaml", "{car}/params/x.yaml"),
        ("$(find car)/params", "{car}/params"),
        ("$(find car):$(find car) $(find car)", "{car}/:{car} {car}"),
    ],
)
def test_a_path_after_find_is_resolved_in_the_package(written: str, expected: str, tmp_path: Path) -> None:
    plan = plan_of(f'<param name="a" value="{written}"/>', packages=Folders({"car": tmp_path}))
    assert plan.params[0].value == expected.format(car=tmp_path)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<param name="a" value="$(find nowhere)"/>', "no package 'nowhere'"),
        ('<param name="a" value="$(arg zzz)"/>', "no argument 'zzz'; none is declared so far"),
        (
            '<arg name="a"/><param name="a" value="$(arg a)"/>',
            "'a' is required and was not given; write a:=VALUE, or launch a file that includes this one",
        ),
        ('<param name="a" value="$(env NO_SUCH)"/>', "the environment variable 'NO_SUCH' is not set"),
        ('<param name="a" value="x$(eval 1)"/>', "eval must be the whole attribute"),
        ('<param name="a" value="$(arg $(arg b))"/>', "substitutions cannot hold one another"),
        ('<param name="a" type="int" value="abc"/>', "param 'a': 'abc' is not an integer"),
        ('<param name="a" type="complex" value="1"/>', "param 'a': no type 'complex'; types are auto"),
        ('<param name="a"/>', "param 'a' needs one of"),
        ('<param name="a" textfile="/no/such"/>', "no file '/no/such'"),
        ('<node pkg="p" name="n"/>', "<node> needs the attribute 'type'"),
        ('<node pkg="p" type="t" name="a/b"/>', "node name 'a/b' holds a '/'"),
        (NODE + NODE, "two nodes are named '/n'; the other one is at t.launch:1"),
        ('<node pkg="p" type="t" name="n" respawn="1"/>', "respawn: '1' is neither 'true' nor 'false'"),
        ('<node pkg="p" type="t" name="n" respawn="true" required="true"/>', "cannot both be true"),
        ('<group ns=""/>', "empty 'ns'"),
        ('<group clear_params="true"/>', "clear_params needs the attribute 'ns'"),
        ('<remap from="a" to="1/b"/>', "remap to '1/b': not a legal ROS name"),
        ("<rosparam>{a: [1, 2</rosparam>", "rosparam: invalid YAML: line 1"),
        ("<rosparam>[1]</rosparam>", "rosparam needs the attribute 'param'"),
        ('<rosparam>{a: !!python/object/apply:os.system ["id"]}</rosparam>', "could not determine a constructor"),
        ("<rosparam>&amp;a [*a]</rosparam>", "a value contains itself"),
        ("<rosparam>{a: rad(1/0)}</rosparam>", "'rad(1/0)' is not an angle in radians"),
        ("<rosparam>" + "[" * 5000 + "</rosparam>", "invalid YAML: nested too deeply"),
        ('<rosparam command="burn"/>', "rosparam command 'burn'; there are"),
        ('<include file="/no/such.launch"/>', "no launch file '/no/such.launch' to include"),
        ('<param name="a" value="1" if="maybe"/>', "'maybe' is neither true, false, 1 nor 0"),
    ],
)
def test_faults_that_roslaunch_refuses_are_refused_with_an_error(body: str, message: str) -> None:
    with pytest.raises(DescriptionError) as error:
        plan_of(body)
    assert str(error.value).startswith("t.launch:1: error: ")
    assert message in str(error.value)


def test_an_alias_bomb_is_refused_at_once() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 12)]
    text = "\n".join(lines).replace("&", "&amp;")
    with pytest.raises(DescriptionError, match="its aliases stand for more than"):
        plan_of(f"<rosparam>\n{text}\n</rosparam>")


def test_unknown_elements_are_reported_and_reading_goes_on() -> None:
    report = Diagnostics()
    plan = plan_of(
        f'<nodde/><param name="a" value="1" colour="red"/><master/>{NODE}',
        report=report,
    )
    assert len(plan.nodes) == 1
    assert [warning.partition("warning: ")[2] for warning in report.warnings] == [
        "<nodde> is not a tag of launch files; it is ignored",
        "attribute 'colour' of <param> is not known; it is ignored",
        "<master> has no effect since ROS 0.7; it is ignored",
    ]


def test_an_argument_that_the_file_does_not_have_is_an_error() -> None:
    """roslaunch starts without a warning and ignores the misspelt argument."""
    with pytest.raises(DescriptionError, match="no argument 'sped' to set; the file's arguments: 'speed'"):
        plan_of('<arg name="speed" default="1"/>', sped="2")


def test_an_argument_that_is_used_and_not_declared_may_be_set() -> None:
    """The SolidWorks exporter writes such files; roslaunch takes `gui:=1` for them."""
    plan = plan_of(
        '<param name="use_gui" value="$(arg gui)"/><param name="b" value="$(eval rate * 2)"/>', gui="1", rate="3"
    )
    assert {p.name: p.value for p in plan.params} == {"/use_gui": 1, "/b": 6}
    unused = '<arg name="q" default="0"/><group if="$(arg q)"><param name="a" value="$(arg gui)"/></group>'
    assert plan_of(unused, gui="1").params == ()
    with pytest.raises(DescriptionError, match="no argument 'gui'; none is declared so far"):
        plan_of('<param name="use_gui" value="$(arg gui)"/>')
    with pytest.raises(DescriptionError, match="no argument 'gui'; none is declared so far; 'guii' is given"):
        plan_of('<param name="use_gui" value="$(arg gui)"/>', guii="1")
    with pytest.raises(DescriptionError, match="no argument 'guii' to set; the file's arguments: 'gui'"):
        plan_of('<param name="use_gui" value="$(arg gui)"/>', gui="1", guii="1")
    both = '<param name="a" value="$(arg gui)"/><param name=\'b\' value=\'$(eval arg("rate"))\'/>'
    with pytest.raises(DescriptionError, match="the nearest is 'rate'; the file's arguments: 'gui', 'rate'"):
        plan_of(both, gui="1", rate="2", rat="3")


def test_an_argument_may_be_set_that_an_included_file_is_passed(tmp_path: Path) -> None:
    write(tmp_path, "sub.launch", WITH_ARGS)
    passing = write(tmp_path, "top.launch", '<include file="$(dirname)/sub.launch" pass_all_args="true"/>')
    arguments = {"q": "4"}
    plan = read_launch(passing, packages=Folders(), report=Diagnostics(), arguments=arguments)
    assert {p.name: p.value for p in plan.params} == {"/r": "4x"}

    body = '<include file="$(dirname)/sub.launch"><arg name="q" value="1"/></include>'
    keeping = write(tmp_path, "top.launch", body)
    with pytest.raises(DescriptionError, match="no argument 'q' to set"):
        read_launch(keeping, packages=Folders(), report=Diagnostics(), arguments=arguments)


def write(folder: Path, name: str, body: str) -> Path:
    path = folder / name
    path.write_text(f"<launch>{body}</launch>")
    return path


def included(folder: Path, body: str, *, report: Diagnostics | None = None, is_lenient: bool = False) -> LaunchPlan:
    path = write(folder, "top.launch", body)
    return read_launch(path, packages=Folders(is_lenient=is_lenient), report=report or Diagnostics())


WITH_ARGS = '<arg name="q"/><arg name="r" default="$(arg q)x"/><param name="r" value="$(arg r)"/>'


def test_an_included_file_sees_only_the_arguments_it_is_passed(tmp_path: Path) -> None:
    write(tmp_path, "sub.launch", WITH_ARGS)
    plan = included(tmp_path, '<include file="$(dirname)/sub.launch" ns="s"><arg name="q" value="9"/></include>')
    assert {p.name: p.value for p in plan.params} == {"/s/r": "9x"}
    assert plan.files == (tmp_path / "top.launch", tmp_path / "sub.launch")

    wrong = r"sub\.launch:1: error: the argument 'q' is required .*; included at .*top\.launch:1 \[launch-arg\]$"
    with pytest.raises(DescriptionError, match=wrong):
        included(tmp_path, '<arg name="q" value="1"/><include file="$(dirname)/sub.launch"/>')


def test_missing_packages_are_named_together(tmp_path: Path) -> None:
    """Packages of nodes count, too."""
    write(
        tmp_path,
        "sub.launch",
        '<include file="$(find one)/a.launch"/>\n<param name="a" textfile="$(find two)/a.txt"/>\n'
        '<group if="false"><param name="b" value="$(find unwanted)"/></group>',
    )
    with pytest.raises(DescriptionError) as caught:
        included(
            tmp_path,
            '<include file="$(dirname)/sub.launch"/>\n<node pkg="turtlebot3_gazebo" type="t" name="n" ns="s"/>\n'
            "<arg name=\"model\" default=\"$(eval find('three') + '/x')\"/>"
            '<include file="$(find two)/b.launch"><arg name="x" value="$(find one)"/></include>',
        )
    sub, top = tmp_path / "sub.launch", tmp_path / "top.launch"
    assert str(caught.value).splitlines() == [
        f"{sub}:1: error: no package 'one'; included at {top}:1 [missing-package]",
        f"{sub}:2: error: no package 'two' [missing-package]",
        f"{top}:2: error: no package 'turtlebot3_gazebo' for the node /s/n; it is published at "
        "https://github.com/ROBOTIS-GIT/turtlebot3_simulations [missing-package]",
        f"{top}:3: error: no package 'three' [missing-package]",
    ]
    assert [error.at.line for error in caught.value.more] == [2, 2, 3]


def test_elements_that_need_missing_packages_are_left_out_on_request(tmp_path: Path) -> None:
    """Each with its line; arguments that no element uses do no harm."""
    write(tmp_path, "sub.launch", '<node pkg="here" type="t" name="kept"/><include file="$(find two)/c.launch"/>')
    text = """<arg name="model" default="$(find one)/m.xacro"/>
<param name="robot_description" command="xacro $(arg model)"/>
<include file="$(find one)/launch/b.launch"/>
<include file="$(dirname)/sub.launch"/>
<node pkg="here" type="t" name="n"><param name="f" value="$(find two)/f"/></node>
<rosparam file="$(find two)/a.yaml"/>
<param name="a" value="1"/>"""
    report = Diagnostics()

    plan = included(tmp_path, text, report=report, is_lenient=True)

    assert [node.name for node in plan.nodes] == ["kept"]
    assert [param.name for param in plan.params] == ["/a"]
    top, sub = tmp_path / "top.launch", tmp_path / "sub.launch"
    assert report.warnings == [
        f"{top}:2: warning: no package 'one'; <param> robot_description is left out",
        f"{top}:3: warning: no package 'one'; <include> one/launch/b.launch is left out",
        f"{sub}:1: warning: no package 'two'; <include> two/c.launch is left out",
        f"{top}:5: warning: no package 'two'; the node 'n' (here/t) is left out",
        f"{top}:6: warning: no package 'two'; <rosparam> two/a.yaml is left out",
    ]


def test_all_arguments_are_passed_when_asked_for(tmp_path: Path) -> None:
    write(tmp_path, "sub.launch", WITH_ARGS)
    plan = included(tmp_path, '<arg name="q" value="4"/><include file="$(dirname)/sub.launch" pass_all_args="true"/>')
    assert {p.name: p.value for p in plan.params} == {"/r": "4x"}


def test_an_argument_the_included_file_lacks_is_an_error(tmp_path: Path) -> None:
    write(tmp_path, "sub.launch", NODE)
    with pytest.raises(DescriptionError, match="has no argument 'zz'; its arguments: none"):
        included(tmp_path, '<include file="$(dirname)/sub.launch"><arg name="zz" value="1"/></include>')


def test_a_file_that_includes_itself_is_refused(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError, match="it may include itself"):
        included(tmp_path, '<include file="$(dirname)/top.launch"/>')


def test_declared_arguments_are_listed_for_the_command_line() -> None:
    plan = plan_of('<arg name="a"/><arg name="b" default="1" doc="how many"/><arg name="c" value="2"/>')
    listed = [(a.name, a.default, a.doc, a.required) for a in plan.arguments]
    assert listed == [("a", None, "", True), ("b", "1", "how many", False), ("c", None, "", False)]


def test_a_default_machine_is_that_of_the_nodes_behind_it() -> None:
    plan = plan_of(
        '<node pkg="p" type="t" name="before"/><machine name="m" address="a" default="true"/>'
        '<machine name="never" address="a" default="never"/>'
        '<node pkg="p" type="t" name="after"/><node pkg="p" type="t" name="own" machine="localhost"/>'
    )
    assert {node.name: node.machine for node in plan.nodes} == {"before": "", "after": "m", "own": "localhost"}
    assert {node.name: node.address for node in plan.nodes} == {"before": "", "after": "a", "own": ""}


def test_an_invalid_default_of_a_machine_is_refused() -> None:
    with pytest.raises(DescriptionError, match="default 'maybe'; there are true, false, never"):
        plan_of('<machine name="m" address="a" default="maybe"/>')


def test_blank_lines_before_the_declaration_are_named(tmp_path: Path) -> None:
    """roslaunch's parser, expat, refuses them."""
    report = Diagnostics()
    inner, outer = tmp_path / "i.launch", tmp_path / "o.launch"
    inner.write_text('\n<?xml version="1.0"?><launch/>')
    outer.write_text(f'\n<launch><include file="{inner}"/></launch>')

    read_launch(outer, packages=Folders(), report=report)

    assert report.warnings == [
        f"{inner}:1: warning: blank lines before <?xml …?>, for which roslaunch refuses the file"
    ]

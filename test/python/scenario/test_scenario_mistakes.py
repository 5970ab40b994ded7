"""Every mistake of a section is found, and told with key, value, remedy and line."""

import pytest

from deformable_manipulation.reading.document import parse_document
from deformable_manipulation.scenario import ScenarioError, load_scenario

WRONG_VALUES = [
    ("name", "", "one line"),
    ("name", "a/b", "one line"),
    ("name", "a" * 101, "at most 100 characters"),
    ("frame", "/map", "tf frame"),
    ("object.type", "fabrik", "one of rod, fabric; did you mean 'fabric'?"),
    ("object.length", 0, "a number"),
    ("object.length", "long", "a number"),
    ("object.length", True, "true must be a number > 0"),
    ("object.length", None, "empty must be a number > 0"),
    ("object.length", float("nan"), "nan must be a number"),
    ("object.length", float("inf"), "inf must be a number"),
    ("object.density", [1], "a number > 0 and <= 100000 [kg/m^3]"),
    ("object.young_modulus", 10**400, "a number > 0 and <= 1e+13 [Pa]"),
    ("object.radius", 1.0, "half of object.length (2 m)"),
    ("object.segments", 1, "from 2 to 10000"),
    ("object.segments", 10.5, "a whole number"),
    ("object.segments", float("nan"), "a whole number"),
    ("object.damping", -1, "a number >= 0 and <= 10000 [1/s]"),
    ("object.torsion_retardation_time", -1, "a number >= 0 and <= 100 [s]"),
    ("object.stretch", "zer", "did you mean 'zero'?"),
    ("object.pose", [0, 0, 0], "a section with keys position, orientation"),
    ("object.pose.orientation", [0, 0, 0, 2], "norm 1"),
    ("object.pose.orientation", [0, 0, 1], "[x, y, z, w]"),
    ("agents", {}, "one section per agent"),
    ("agents", [1], "one section per agent"),
    ("agents.hand.particle", 10, "0 to 9"),
    ("agents.hand.particle", -1, "a whole number from 0"),
    ("agents.hand.particle", 9, "held by agent"),
    ("agents.hand.role", "boss", "one of leader, assistant"),
    ("agents.hand.hold", "clamp", "did you mean 'clamped'?"),
    ("agents.hand.start", [0, 0], "[x, y, z]"),
    ("obstacles", {"name": "x"}, "a list of obstacles"),
    ("obstacles.0", 3, "a section with a name, one of the keys polygon"),
    ("obstacles.0.polygon", 3, "CSV or GeoJSON file"),
    ("obstacles.0.polygon", "absent.csv", "cannot be read"),
    ("obstacles.0.polygon", [[0, 0], [1, 1]], "3 distinct points"),
    ("obstacles.0.polygon", [[0, 0], [1, 1], [1, 0], [0, 1]], "crosses or touches itself at (0.5"),
    ("obstacles.0.plane", "zy", "one of xy, yz, xz"),
    ("leader.waypoints", [], "a list of waypoints"),
    ("leader.waypoints.0.time", 1.0, "must be 0"),
    ("leader.waypoints.0.position", [0, 0, 1], "relative to the leader's start"),
    ("leader.waypoints.1.time", 0.0, "s later than the waypoint before"),
    ("leader.waypoints.1.time", 5e-324, "at least 0.001 s later than the waypoint before"),
    ("leader.waypoints.1.position", [0, 99, 0], "m from the waypoint before, 5 m/s in"),
    ("leader.workspace", "big", "a section with keys lower, upper"),
    ("leader.workspace", {"lower": [0, 0, 9], "upper": [1, 1, 1]}, "below its upper one in z"),
    ("leader.workspace", {"lower": [1, 1, 1], "upper": [2, 2, 2]}, "the leader's start"),
    ("leader.max_velocity", 0, "a number > 0 and <= 5 [m/s]"),
    ("leader.max_acceleration", -1, "a number > 0 and <= 1000 [m/s^2]"),
    ("controller.rate", 0, "a number"),
    ("controller.gain", -1, "-1 must be a number > 0 [1/s]"),
    ("controller.weights", [1, 1], "[x, y, z]"),
    ("controller.horizon.weights", [1e6, 1e-6, 1], "factor of 100"),
    ("controller.horizon.nodes", 0, "a whole number from 1 to 32"),
    ("controller.feedforward", 1, "true or false"),
    ("controller.solver", "quadprg", "did you mean 'quadprog'?"),
    ("controller.formulation", "papers", "did you mean 'paper'?"),
    ("controller.priority", ["collision", "proximity"], "each barrier in use once"),
    ("controller.priority", "collision", "a list of the names"),
    ("controller.priority", ["collision", "collision", "proximity"], "name each of"),
    ("controller.collision.margin", -0.1, "a number >= 0"),
    ("controller.collision.speed_margin", 11, "a number >= 0 and <= 10 [s]"),
    ("controller.collision.anticipation", [0.4], "slope for h >= 0"),
    ("controller.collision.offset", -0.1, "a number >= 0 and <= 1e+06 [m]"),
    ("controller.collision.offset", 1.7e308, "a number >= 0 and <= 1e+06 [m]"),
    ("controller.collision.band", 1.7e308, "a number >= 0 and <= 1e+06 [m]"),
    ("controller.collision.alpha", [1], "slope for h >= 0"),
    ("controller.collision.gradient", "all", "one of features, minimum"),
    ("controller.overstretch.max_distance", "automatic", "a number > 0 [m] or auto"),
    ("controller.proximity.min_distance", -1, "a number >= 0 [m] or auto"),
    ("simulation.duration", 0, "a number"),
    ("simulation.substeps", 0, "from 1"),
    ("simulation.solver", "jacobi", "one of direct, gauss_seidel"),
]


@pytest.mark.parametrize("key, value, expected", WRONG_VALUES)
def test_wrong_value(mapping, change, problems_of, key, value, expected):
    found = problems_of(change(mapping, key, value))
    related = [text for name, text in found.items() if name == key or key.startswith("agents")]
    assert related, found
    assert any(expected in text for text in related)


@pytest.mark.parametrize(
    "key, value, item",
    [
        ("object.pose.position", [0, "a", 0], "1"),
        ("controller.weights", [1, 1, 0], "2"),
        ("controller.perturbation", [0, 0.1, 0.1], "0"),
        ("controller.perturbation", [0.1, 5e-324, 0.1], "1"),
        ("controller.collision.alpha", [0, 1], "0"),
        ("simulation.gravity", [0, 0, True], "2"),
        ("agents.hand.start", [0, 0, 1e7], "2"),
    ],
)
def test_wrong_item_is_named(mapping, change, problems_of, key, value, item):
    assert set(problems_of(change(mapping, key, value))) == {"{}.{}".format(key, item)}


@pytest.mark.parametrize(
    "key",
    [
        "object",
        "agents",
        "leader",
        "controller",
        "simulation",
        "object.type",
        "object.length",
        "agents.hand.particle",
        "agents.hand.role",
        "obstacles.0.name",
        "obstacles.0.polygon",
        "leader.waypoints",
        "leader.waypoints.1.time",
        "controller.collision",
        "controller.collision.offset",
        "simulation.duration",
    ],
)
def test_missing_key(mapping, problems_of, key):
    *parents, last = key.split(".")
    section = mapping
    for parent in parents:
        section = section[int(parent)] if isinstance(section, list) else section[parent]
    del section[last]
    found = problems_of(mapping)
    assert list(found) == [key]
    assert "is missing; give " in found[key]


@pytest.mark.parametrize(
    "key, suggestion",
    [
        ("controler", "controller"),
        ("object.densty", "density"),
        ("agents.hand.partikle", "particle"),
        ("obstacles.0.plan", "plane"),
        ("leader.waypoint", "waypoints"),
        ("controller.gains", "gain"),
        ("controller.collision.ofset", "offset"),
        ("simulation.timestep", "time_step"),
    ],
)
def test_unknown_key_suggests_the_nearest(mapping, change, problems_of, key, suggestion):
    found = problems_of(change(mapping, key, 1))
    assert list(found) == [key]
    assert "did you mean '{}'?".format(suggestion) in found[key]


@pytest.mark.parametrize("name", ["2nd", "left arm", "a/b", "", "arm-1"])
def test_agent_names_are_parts_of_topic_names(mapping, problems_of, name):
    mapping["agents"][name] = mapping["agents"].pop("helper")
    assert "letters, digits and _" in problems_of(mapping)["agents.{}".format(name)]


def test_roles(mapping, change, problems_of):
    assert (
        "these have it: hand, helper"
        in problems_of(change(mapping, "agents.helper.role", "leader"))["agents"]
    )
    assert (
        "none has it"
        in problems_of(
            change(
                change(mapping, "agents.helper.role", "assistant"), "agents.hand.role", "assistant"
            )
        )["agents"]
    )
    del mapping["agents"]["helper"]
    mapping["agents"]["hand"]["role"] = "leader"
    assert "at least one agent with role assistant" in problems_of(mapping)["agents"]


def test_obstacle_names_are_unique(mapping, problems_of):
    mapping["obstacles"].append(dict(mapping["obstacles"][0]))
    assert list(problems_of(mapping)) == ["obstacles.1.name"]


def test_no_mapping_at_all(problems_of):
    assert "a section with keys name, object, agents" in problems_of([1, 2])[""]


TEXT = """\
object: {type: rod, length: 2.0, radius: 0.01, density: 1000, segments: 10,
         young_modulus: 1.0e+7, torsion_modulus: 4.0e+6, weight: 3}
agents:
  hand: {particle: 0, role: leader}
  helper: {particle: 9, role: assistant, start: [1.5, 0.0, nowhere]}
leader: {waypoints: [{time: 0, position: [0, 0, 0]}]}
controller:
  gain: -1
  collision: {offset: 0.1}
simulation:
  duration: 4
  duration: 5
"""


def test_all_mistakes_at_once_with_their_lines(tmp_path):
    path = tmp_path / "wrong.yaml"
    path.write_text(TEXT)
    with pytest.raises(ScenarioError) as caught:
        load_scenario(path)
    lines = {problem.key: problem.line for problem in caught.value.problems}
    assert lines == {
        "object.weight": 2,
        "agents.helper.start.2": 5,
        "controller.gain": 8,
        "simulation.duration": 12,
    }
    text = str(caught.value)
    assert text.splitlines()[0] == "{}: 4 mistakes".format(path)
    assert "  controller.gain: -1 \u2014 must be a number > 0 [1/s] (line 8)" in text.splitlines()
    assert "appears twice, first on line 11" in text


@pytest.mark.parametrize(
    "text, line",
    [("a: 1\nb: ]\n", 2), ("a: 1\n\tb: 2\n", 2), ("a: &x 1\nb: *y\n", 2), ("a: !wrong 1\n", 1)],
)
def test_syntax_errors_tell_the_line(text, line):
    with pytest.raises(ScenarioError, match="not valid YAML") as caught:
        parse_document(text)
    assert caught.value.problems[0].line == line


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"# only a comment\n",
        b"\xff\xfe\x00",
        b"a: 2001-99-99",
        b"a: !!int ''",
        b"\x00",
        b"a: !!timestamp x",
        b"--- 1\n--- 2\n",
        b"? [1]\n: 2",
        b"[" * 5000,
    ],
)
def test_files_that_hold_no_scenario(tmp_path, content):
    path = tmp_path / "x.yaml"
    path.write_bytes(content)
    with pytest.raises(ScenarioError) as caught:
        load_scenario(path)
    assert str(path) in str(caught.value)


def test_integers_too_long_to_print(tmp_path):
    path = tmp_path / "x.yaml"
    long_integer = "0x" + "f" * 6000
    path.write_text("? {0}\n: 1\nagents:\n  ? {0}\n  : 1\nname: {0}\n".format(long_integer))
    with pytest.raises(ScenarioError) as caught:
        load_scenario(path)
    assert "name: an integer of more than 40 digits" in str(caught.value)


def test_names_that_no_file_can_have(mapping, change, problems_of):
    for name in ("x" * 5000, "a\0b", "package://", "package://a b/c", "."):
        assert list(problems_of(change(mapping, "obstacles.0.polygon", name)))
        with pytest.raises(ScenarioError):
            load_scenario(name)


def test_aliases_that_contain_themselves(tmp_path):
    path = tmp_path / "x.yaml"
    path.write_text("object: &x [*x]\nagents: &y {a: *y}\n")
    with pytest.raises(ScenarioError):
        load_scenario(path)


def test_messages_stay_short_for_nested_aliases(tmp_path):
    levels = ["a0: &a0 [1, 2, 3, 4, 5, 6, 7, 8, 9]"]
    levels += [
        "a{0}: &a{0} [{1}]".format(i, ", ".join(["*a{}".format(i - 1)] * 9)) for i in range(1, 12)
    ]
    path = tmp_path / "x.yaml"
    path.write_text("\n".join(levels + ["object: *a11"]))
    with pytest.raises(ScenarioError) as caught:
        load_scenario(path)
    assert all(len(str(problem)) < 500 for problem in caught.value.problems)

"""The launch file of a scenario: a few lines over run.launch."""

import xml.etree.ElementTree as ElementTree
from xml.sax.saxutils import quoteattr

from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.system.package_files import PACKAGE, package_share_directory

# Arguments of run.launch that a scenario's launch file sets itself, or leaves to tests.
NOT_PASSED_ON = (
    "scenario",
    "assistants",
    "leader",
    "rviz_config",
    "required",
    "observers",
    "camera",
)

_LAUNCH = """\
<launch>
  <!-- {name}: the scenario {scenario} in RViz. -->
{arguments}

  <include file="$(find {package})/launch/run.launch" pass_all_args="true">
{settings}
  </include>
</launch>
"""


def launch_file(scenario: Scenario, scenario_file: str, rviz_file: str) -> str:
    """The text of a launch file with the arguments of run.launch.

    Args:
        scenario: what its arguments follow from.
        scenario_file: and ``rviz_file``: as the launch file finds them, with substitutions.
    """
    run = ElementTree.parse(str(package_share_directory() / "launch" / "run.launch")).getroot()
    attributes = [each.attrib for each in run.findall("arg")]
    known = {given["name"]: given for given in attributes if "default" in given}
    names = " ".join(scenario.agents[index].name for index in scenario.assistants)
    arguments = [dict(known["assistants"], default=names)]
    arguments += [given for name, given in known.items() if name not in NOT_PASSED_ON]
    if scenario.camera is not None:
        arguments.append(dict(known["camera"], default="true"))
    settings = {"scenario": scenario_file, "rviz_config": rviz_file}
    leader = scenario.agents[scenario.leader_index].name
    if leader != known["leader"]["default"]:
        settings["leader"] = leader
    return _LAUNCH.format(
        name=scenario.name,
        scenario=scenario_file,
        package=PACKAGE,
        arguments="\n".join("  " + _argument(given) for given in arguments),
        settings="\n".join(
            "    " + _argument({"name": name, "value": value}) for name, value in settings.items()
        ),
    )


def _argument(attributes) -> str:
    return "<arg {}/>".format(
        " ".join("{}={}".format(name, quoteattr(value)) for name, value in attributes.items())
    )

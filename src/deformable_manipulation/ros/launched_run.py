"""How a run of a checked scenario, or what draws a recorded one, is launched."""

from pathlib import Path

from deformable_manipulation.scenario import package_share_directory, scenario_to_yaml


def launch_command(scenario, directory, **options):
    """The roslaunch command of a run, on this process's master, without RViz.

    Args:
        scenario: the checked scenario.
        directory: existing folder, into which its file is written.
        options: arguments of run.launch.

    Returns:
        Program and arguments.
    """
    defaults = {
        "assistants": " ".join(scenario.agents[index].name for index in scenario.assistants),
        "leader": scenario.agents[scenario.leader_index].name,
        "camera": "true" if scenario.camera else "false",
        "stop_at_end": "false",
    }
    return _roslaunch("run.launch", scenario, directory, {**defaults, **options})


def playback_command(scenario, directory):
    """The same for playback.launch, which draws the states that somebody publishes."""
    return _roslaunch("playback.launch", scenario, directory, {})


def _roslaunch(name, scenario, directory, options):
    path = Path(directory) / (scenario.name + ".yaml")
    path.write_text(scenario_to_yaml(scenario), encoding="utf-8")
    options = {"scenario": path, "rviz": "false", **options}
    launch_file = package_share_directory() / "launch" / name
    return ["roslaunch", str(launch_file), *(f"{key}:={value}" for key, value in options.items())]

"""Every command that writes into a folder refuses one without a name."""

import importlib

import pytest

COMMANDS = {
    "benchmark": ["--list"],
    "identify": ["swing.csv", "--object", "rope_one_assistant"],
    "new_scenario": ["my_own"],
    "plot_run": ["run"],
    "replay": ["swing.csv", "--object", "rope_one_assistant"],
    "run_campaign": ["rope_one_assistant"],
    "run_scenario": ["rope_one_assistant"],
    "rviz_snapshot": ["rope_one_assistant"],
    "validate": [],
}


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", ["", "  "])
def test_an_empty_name_is_wrong_usage(command, name, capsys):
    module = importlib.import_module("deformable_manipulation.commands." + command)
    with pytest.raises(SystemExit) as caught:
        module.main([*COMMANDS[command], "--output", name])
    assert caught.value.code == 2
    assert "--output: is empty; name a folder" in capsys.readouterr().err

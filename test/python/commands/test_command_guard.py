"""Commands whose output cannot be written, or which are interrupted, end in one line."""

import importlib
import signal
import subprocess
import sys
import types

import pytest

from deformable_manipulation.commands.guard import run_command
from deformable_manipulation.system.package_files import package_share_directory

CHECK = [sys.executable, "-m", "deformable_manipulation.commands", "check_scenario"]
CHECK += ["rope_one_assistant", "--resolved"]
SCRIPTS = package_share_directory() / "scripts"
COMMANDS = sorted(
    path.name
    for path in SCRIPTS.iterdir()
    if "-m deformable_manipulation.commands" in path.read_text()
)


def test_a_full_disk():
    with open("/dev/full", "w") as full:
        ended = subprocess.run(CHECK, stdout=full, stderr=subprocess.PIPE, text=True)
    assert ended.returncode == 1
    assert ended.stderr == "check_scenario: cannot write the output: No space left on device\n"


def test_a_reader_that_has_gone():
    with subprocess.Popen(CHECK, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        run.stdout.close()
        assert run.stderr.read() == ""
    assert run.returncode == 128 + signal.SIGPIPE


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interruption(number, monkeypatch, capsys):
    command = types.ModuleType("a_command")
    command.main = lambda arguments: signal.raise_signal(number)
    monkeypatch.setitem(sys.modules, "deformable_manipulation.commands.a_command", command)
    assert run_command("a_command", []) == 128 + number
    assert capsys.readouterr() == ("", "")


def test_a_file_that_is_missing_is_named(monkeypatch, capfd):
    command = types.ModuleType("a_command")
    command.main = lambda arguments: open("/nowhere/a_file")
    monkeypatch.setitem(sys.modules, "deformable_manipulation.commands.a_command", command)
    monkeypatch.setattr("deformable_manipulation.commands.guard._discard_output", lambda: None)
    assert run_command("a_command", []) == 1
    assert capfd.readouterr().err == "a_command: /nowhere/a_file: No such file or directory\n"


def test_a_library_that_is_not_installed_is_named(monkeypatch, capfd):
    command = types.ModuleType("a_command")
    command.main = lambda arguments: importlib.import_module("no_such_library")
    monkeypatch.setitem(sys.modules, "deformable_manipulation.commands.a_command", command)
    assert run_command("a_command", []) == 1
    message = "a_command: the Python module 'no_such_library' is needed but not installed\n"
    assert capfd.readouterr().err == message


def test_the_exit_status_of_wrong_usage(capsys):
    assert run_command("check_scenario", ["a.yaml", "--nonsense"]) == 2
    assert "unrecognized arguments: --nonsense" in capsys.readouterr().err


def test_an_interruption_that_a_library_turns_into_another_error(monkeypatch, capsys):
    def main(arguments):
        try:
            signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            raise ImportError("initialization failed") from None

    command = types.ModuleType("a_command")
    command.main = main
    monkeypatch.setitem(sys.modules, "deformable_manipulation.commands.a_command", command)
    assert run_command("a_command", []) == 128 + signal.SIGINT
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize("name", COMMANDS)
def test_scripts_ignore_an_interruption_until_their_command_is_there(name):
    lines = (SCRIPTS / name).read_text().splitlines()
    assert lines[1].startswith("trap '' INT")

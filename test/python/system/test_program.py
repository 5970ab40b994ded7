import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from deformable_manipulation.system.program import Program, ProgramCrashed, ProgramError

DEADLINE = 30.0  # s, for what takes a fraction of it


def shell(tmp_path, script):
    return Program("trial", ["sh", "-c", script], tmp_path / "log")


def is_running(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_a_program_is_ended_on_leaving(tmp_path):
    with shell(tmp_path, "echo $$; exec sleep 1000") as program:
        pid = int(program.wait_until((tmp_path / "log").read_text, DEADLINE, "it did not start"))
        assert is_running(pid)
    assert not is_running(pid)


def test_its_own_programs_are_ended_with_it(tmp_path):
    with shell(tmp_path, "sleep 1000 & echo $!; wait") as program:
        pid = int(program.wait_until((tmp_path / "log").read_text, DEADLINE, "it did not start"))
    deadline = time.monotonic() + DEADLINE
    while is_running(pid) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not is_running(pid)


def test_a_program_that_ends_by_itself_is_told_with_its_last_words(tmp_path):
    with shell(tmp_path, "printf '\\033[31mno such thing\\033[0m\\n'; exit 3") as program:
        with pytest.raises(ProgramError) as error:
            program.wait_until(lambda: False, DEADLINE, "")
    assert str(error.value).splitlines() == [
        "trial ended with exit status 3.",
        "Last output of trial:",
        "  no such thing",
    ]


def test_a_crash_is_told_from_an_end(tmp_path):
    with shell(tmp_path, "kill -ABRT $$") as program:
        with pytest.raises(ProgramCrashed, match="trial was ended by signal 6"):
            program.wait_until(lambda: False, DEADLINE, "")


def test_waiting_ends_with_a_complaint(tmp_path):
    with shell(tmp_path, "exec sleep 1000") as program:
        with pytest.raises(ProgramError, match="after 0.1 s it did not sing"):
            program.wait_until(lambda: False, 0.1, lambda: "it did not sing")


def test_a_program_that_is_not_there(tmp_path):
    with Program("trial", ["/no/such/program"], tmp_path / "log") as program:
        with pytest.raises(ProgramError, match="trial ended.*(.|\n)*/no/such/program"):
            program.wait_until(lambda: False, DEADLINE, "")


def test_programs_are_ended_when_the_command_is_killed(tmp_path):
    code = (
        "import sys; from deformable_manipulation.system.program import Program\n"
        "with Program('trial', ['sh', '-c', 'echo $$; exec sleep 1000'], sys.argv[1]):\n"
        "    sys.stdin.read()"
    )
    log = tmp_path / "log"
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path))
    command = subprocess.Popen(
        [sys.executable, "-c", code, str(log)], stdin=subprocess.PIPE, env=environment
    )
    deadline = time.monotonic() + DEADLINE
    while not (log.exists() and log.read_text().strip()):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    pid = int(log.read_text())
    command.send_signal(signal.SIGKILL)
    command.communicate()
    while is_running(pid):
        assert time.monotonic() < deadline
        time.sleep(0.01)

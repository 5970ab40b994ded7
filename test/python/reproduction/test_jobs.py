"""Commands side by side: all are run, a failure ends the others and tells why."""

import io
import os
import re
import sys

import pytest

from deformable_manipulation.reproduction.display import JobDisplay, Running
from deformable_manipulation.reproduction.jobs import Job, JobFailed, run_jobs


def job(tmp_path, name, code, accepted=(0,)):
    return Job(name, (sys.executable, "-c", code), tmp_path / f"{name}.log", accepted)


def display(total, stream=None):
    return JobDisplay("reproduce", total, stream or io.StringIO())


def test_all_jobs_are_run_and_told(tmp_path):
    stream = io.StringIO()
    jobs = [job(tmp_path, name, f"print('{name}')") for name in ("one", "two", "three")]
    run_jobs(jobs, 2, display(3, stream))
    assert [(tmp_path / f"{each.title}.log").read_text() for each in jobs] == [
        "one\n",
        "two\n",
        "three\n",
    ]
    told = [line.split(":")[1] for line in stream.getvalue().splitlines()]
    assert told == [" 1 of 3", " 2 of 3", " 3 of 3"]


def test_statuses_that_are_accepted(tmp_path):
    run_jobs([job(tmp_path, "three", "raise SystemExit(3)", accepted=(0, 3))], 1, display(1))


def test_a_failure_ends_the_others_and_tells_why(tmp_path):
    mark = tmp_path / "mark"
    jobs = [
        job(tmp_path, "endless", f"import time; time.sleep(600); open({str(mark)!r}, 'w')"),
        job(tmp_path, "broken", "raise SystemExit('no such thing')"),
    ]
    with pytest.raises(JobFailed, match="broken ended with exit status 1(.|\n)*no such thing"):
        run_jobs(jobs, 2, display(2))
    assert not mark.exists()


class Terminal(io.StringIO):
    """Tells by a pipe, which a job waits for, that it has shown how far the job is."""

    def __init__(self, pipe):
        super().__init__()
        self._pipe = pipe

    def isatty(self):
        return True

    def write(self, text):
        if "40 %" in text and self._pipe.exists():
            self._pipe.write_text("shown")
            self._pipe.unlink()
        return super().write(text)


def test_a_terminal_shows_what_is_running_until_it_is_done(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    code = f"print('  40 %', flush=True); open({str(pipe)!r}).read()"
    stream = Terminal(pipe)
    run_jobs([job(tmp_path, "long", code)], 1, display(1, stream))
    shown = stream.getvalue()
    assert re.search(r"\r\x1b\[Klong \(\d+ s, 40 %\)", shown)
    assert re.search(r"\r\x1b\[Kreproduce: 1 of 1: long, \d+ s\n$", shown)


def test_a_log_is_told_now_and_then(monkeypatch):
    now = 0.0
    monkeypatch.setattr("time.monotonic", lambda: now)
    stream = io.StringIO()
    shown = display(1, stream)
    for now in range(1, 41):
        shown.running([Running("long", now, "")])
    lines = stream.getvalue().splitlines()
    assert lines == ["reproduce: running: long (15 s)", "reproduce: running: long (30 s)"]

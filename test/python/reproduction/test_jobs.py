"""Commands side by side: all are run, a failure ends the others and tells why."""

import sys

import pytest

from deformable_manipulation.reproduction.jobs import Job, JobFailed, run_jobs


def job(tmp_path, name, code, accepted=(0,)):
    return Job(name, (sys.executable, "-c", code), tmp_path / f"{name}.log", accepted)


def test_all_jobs_are_run_and_told(tmp_path):
    said = []
    jobs = [job(tmp_path, name, f"print('{name}')") for name in ("one", "two", "three")]
    run_jobs(jobs, 2, said.append)
    assert [(tmp_path / f"{each.title}.log").read_text() for each in jobs] == [
        "one\n", "two\n", "three\n"
    ]
    assert [line.split(":")[0] for line in said] == ["1 of 3", "2 of 3", "3 of 3"]


def test_statuses_that_are_accepted(tmp_path):
    run_jobs([job(tmp_path, "three", "raise SystemExit(3)", accepted=(0, 3))], 1, lambda _: None)


def test_a_failure_ends_the_others_and_tells_why(tmp_path):
    mark = tmp_path / "mark"
    jobs = [
        job(tmp_path, "endless", f"import time; time.sleep(600); open({str(mark)!r}, 'w')"),
        job(tmp_path, "broken", "raise SystemExit('no such thing')"),
    ]
    with pytest.raises(JobFailed, match="broken ended with exit status 1(.|\n)*no such thing"):
        run_jobs(jobs, 2, lambda _: None)
    assert not mark.exists()

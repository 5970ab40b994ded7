"""The command run_campaign: a small campaign in processes of this machine and on a cluster."""

import csv
import errno
import json
import os
import signal
import subprocess
import sys

import pytest

from deformable_manipulation.campaign import workers
from deformable_manipulation.campaign.runs import Campaign
from deformable_manipulation.campaign.variation import Ranges
from deformable_manipulation.commands import run_campaign, run_scenario
from deformable_manipulation.scenario import load_scenario

SHORT = ["rope_one_assistant", "--seed", "5", "--duration", "45", "--speed", "0.15"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("campaign") / "three"
    assert run_campaign.main([*SHORT, "--runs", "3", "--output", str(folder)]) == 0
    return folder


def outcomes(folder):
    with open(folder / "runs.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_every_run_has_its_row(folder):
    rows = outcomes(folder)
    assert [int(row["index"]) for row in rows] == [0, 1, 2]
    assert {row["completed"] for row in rows} == {"True"}


def test_the_runs_are_kept_safe_and_are_no_child_s_play(folder):
    content = json.loads((folder / "campaign.json").read_text())
    summary = content["summary"]
    assert summary["runs"] == 3 and summary["not_completed"] == summary["deadlocks"] == 0
    assert {each["runs"] for each in summary["violations"].values()} == {0}
    assert summary["constrained"]["most"] > 0.05
    assert (folder / "campaign.png").stat().st_size > 10000


def test_the_worst_run_is_repeated_by_its_file(folder, tmp_path):
    repeated = tmp_path / "again"
    assert run_scenario.main([str(folder / "worst.yaml"), "--output", str(repeated)]) == 0
    lowest = json.loads((repeated / "summary.json").read_text())["min_distance"]
    name = json.loads((repeated / "summary.json").read_text())["scenario"]
    row = outcomes(folder)[int(name.rsplit("_", 1)[1])]
    assert lowest == pytest.approx(float(row["min_distance"]), abs=1e-9)


def test_without_the_filter_the_campaign_is_not_acceptable(tmp_path):
    arguments = [*SHORT, "--runs", "3", "--no-safety", "--set", "controller.rate=20"]
    code = run_campaign.main([*arguments, "--output", str(tmp_path / "unsafe")])
    assert code == run_campaign.UNACCEPTABLE


def test_classes_are_counted_apart(tmp_path, capsys):
    arguments = ["rope_one_assistant", "--runs", "2", "--duration", "45", "--no-safety"]
    arguments += ["--path", "places,dives", "--speed", "0.1,0.3", "--set", "controller.rate=20"]
    run_campaign.main([*arguments, "--output", str(tmp_path / "classes")])
    content = json.loads((tmp_path / "classes" / "campaign.json").read_text())
    classes = [(each["ranges"]["path"], each["ranges"]["speed"]) for each in content["classes"]]
    assert classes == [("places", 0.1), ("places", 0.3), ("dives", 0.1), ("dives", 0.3)]
    assert [each["summary"]["runs"] for each in content["classes"]] == [2, 2, 2, 2]
    assert content["summary"]["runs"] == 8
    rows = outcomes(tmp_path / "classes")
    assert [int(row["index"]) for row in rows] == list(range(8))
    assert [(row["path"], float(row["speed"])) for row in rows[::2]] == classes
    violated = content["summary"]["violations"]["collision"]
    low, high = violated["interval"]
    assert 0.0 <= low <= violated["runs"] / 8 <= high <= 1.0
    printed = capsys.readouterr().out
    assert "| dives | 0.3 | fading | 2 |" in printed and "with foreknowledge" not in printed


def test_an_older_campaign_is_not_overwritten(folder, capsys):
    assert run_campaign.main([*SHORT, "--runs", "1", "--output", str(folder)]) == 1
    assert "already holds a campaign" in capsys.readouterr().err


@pytest.mark.parametrize(
    "wrong, text",
    [
        (["--runs", "0"], "must be more than 0"),
        (["--runs", "many"], "invalid number"),
        (["--speed", "nan"], "must be more than 0"),
        (["--tolerance", "nan"], "must be a finite number, 0 or more"),
        (["--tolerance", "-1"], "must be a finite number, 0 or more"),
        (["--duration", "1e12"], "must be at most 100000 s"),
        (["--speed", "2.5"], "must be at most 2 m/s"),
        (["--speed", "0.1,0.1"], "each value must be there once"),
        (["--path", "jumps"], "must be places or dives"),
        (["--leader", "absent"], "must be fading or announced or known"),
        (["--seed", "-1"], "must be 0 or more"),
        (["--material", "0.5"], "must be 1"),
        (["--cluster", "nowhere"], "tcp://HOST:PORT"),
    ],
)
def test_wrong_arguments_are_refused(wrong, text, capsys):
    with pytest.raises(SystemExit) as ended:
        run_campaign.main([*SHORT, *wrong])
    assert ended.value.code == 2 and text in capsys.readouterr().err


def test_what_cannot_be_varied_fails_before_anything_is_written(tmp_path, capsys):
    arguments = [*SHORT, "--clearance", "9", "--output", str(tmp_path / "none")]
    assert run_campaign.main(arguments) == 1
    assert "9 m clear" in capsys.readouterr().err
    assert not (tmp_path / "none").exists()


def test_a_folder_that_cannot_be_written_fails_before_any_run(tmp_path, monkeypatch, capsys):
    def refused(folder):
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(run_campaign, "writable_folder", refused)
    assert run_campaign.main([*SHORT, "--output", str(tmp_path)]) == 1
    assert f"cannot write into {tmp_path}: Permission denied" in capsys.readouterr().err


def test_a_folder_below_a_file_fails_before_any_run(tmp_path, capsys):
    (tmp_path / "file").touch()
    assert run_campaign.main([*SHORT, "--output", str(tmp_path / "file" / "out")]) == 1
    assert "choose a writable folder with --output" in capsys.readouterr().err


class Suicidal(Campaign):
    """A campaign whose second run kills its worker the first time."""

    def run(self, index):
        flag = os.environ["CAMPAIGN_TEST_FLAG"]
        if index == 1 and not os.path.exists(flag):
            open(flag, "w").close()
            os.kill(os.getpid(), signal.SIGKILL)
        return super().run(index)


def test_the_runs_of_a_killed_worker_are_done_again(tmp_path, monkeypatch):
    monkeypatch.setenv("CAMPAIGN_TEST_FLAG", str(tmp_path / "killed"))
    scenario = load_scenario("rope_one_assistant", [("controller.rate", "20")])
    campaign = Suicidal(scenario, Ranges(speed=0.15, duration=45.0), seed=1, safety=False)
    found = list(workers.run_here(campaign, range(3), 2))
    assert (tmp_path / "killed").exists()
    assert sorted(outcome.index for outcome in found) == [0, 1, 2]


@pytest.fixture
def scheduler():
    """Address of a Dask scheduler, and a function that starts a worker; each is a process."""
    pytest.importorskip("distributed")
    processes = []

    def start(*arguments):
        command = [sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:]]
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        processes.append(process)
        return process

    started = start("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    address = next(line.split()[-1] for line in started.stderr if "Scheduler at:" in line).strip()
    yield (
        address,
        lambda: start("dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"),
    )
    for process in processes:
        process.kill()
        process.communicate()


@pytest.fixture
def cluster(scheduler):
    """Address of a Dask scheduler with two workers."""
    address, start_worker = scheduler
    for _ in range(2):
        start_worker()
    return address


def test_a_cluster_gives_the_same_outcomes(folder, cluster, tmp_path):
    arguments = [*SHORT, "--runs", "3", "--output", str(tmp_path / "cluster")]
    assert run_campaign.main([*arguments, "--cluster", cluster]) == 0
    assert outcomes(tmp_path / "cluster") == outcomes(folder)


def test_a_cluster_that_is_not_there(tmp_path, capsys):
    arguments = [*SHORT, "--runs", "1", "--output", str(tmp_path / "none")]
    assert run_campaign.main([*arguments, "--cluster", "tcp://127.0.0.1:9"]) == 1
    assert "run_campaign:" in capsys.readouterr().err


def test_a_cluster_whose_workers_come_late(folder, scheduler, monkeypatch):
    address, start_worker = scheduler
    client = pytest.importorskip("distributed").Client
    wait = client.wait_for_workers

    def wait_from_now_on(self, *arguments, **settings):
        start_worker()
        return wait(self, *arguments, **settings)

    monkeypatch.setattr(client, "wait_for_workers", wait_from_now_on)
    scenario = load_scenario("rope_one_assistant")
    campaign = Campaign(scenario, Ranges(speed=0.15, duration=45.0), seed=5)
    (outcome,) = workers.run_on_cluster(campaign, [0], address)
    assert outcome.min_distance == pytest.approx(float(outcomes(folder)[0]["min_distance"]))


def test_a_cluster_without_workers(scheduler, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(workers, "_PATIENCE", 0.1)
    arguments = [*SHORT, "--runs", "1", "--output", str(tmp_path / "none")]
    assert run_campaign.main([*arguments, "--cluster", scheduler[0]]) == 1
    assert "no worker connected to the scheduler at tcp://127.0.0.1" in capsys.readouterr().err


@pytest.mark.parametrize("done", [0, 1])
def test_an_interrupted_campaign_says_what_it_kept(tmp_path, monkeypatch, capsys, done):
    run_here = workers.run_here

    def interrupted(campaign, indices, count):
        yield from run_here(campaign, list(indices)[:done], count)
        raise KeyboardInterrupt

    monkeypatch.setattr(workers, "run_here", interrupted)
    folder = tmp_path / "interrupted"
    status = run_campaign.main([*SHORT, "--runs", "3", "--output", str(folder)])
    assert status == 128 + signal.SIGINT
    last = capsys.readouterr().err.splitlines()[-1]
    if done:
        assert len(outcomes(folder)) == 1
        assert f"only 1 of 3 runs were done. They are kept in {folder / 'runs.csv'}" in last
    else:
        assert last == "run_campaign: no run had finished, so nothing is kept"

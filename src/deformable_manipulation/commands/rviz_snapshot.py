"""Saves pictures and videos of a scenario or a recorded run as RViz shows it, without a screen."""

import argparse
import sys
import tempfile
from functools import partial
from typing import Optional, Sequence

from deformable_manipulation.authoring.rviz_choice import own_configuration, rviz_configuration
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.commands.output_folder import writable_folder
from deformable_manipulation.commands.snapshot_arguments import (
    AUTO,
    NAME,
    OVERLAID,
    SEPARATE,
    SIDE_BY_SIDE,
    SIZE,
    SIZE_IN_A_ROW,
    parse_arguments,
)
from deformable_manipulation.commands.snapshot_source import SnapshotSource, read_source
from deformable_manipulation.recording import RunDataError
from deformable_manipulation.scenario import ScenarioError
from deformable_manipulation.system.interruption import exit_status, interruptible


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = parse_arguments(argv)
    try:
        source = read_source(arguments.source, arguments.set, arguments.namespace)
        _complete(arguments, source)
        _check(arguments, source)
    except ScenarioError as error:
        print(error, file=sys.stderr)
        return 1
    except (RunDataError, ValueError) as error:
        return fail(NAME, str(error))
    except OSError as error:
        return fail(NAME, f"cannot write the pictures: {error}")
    # Imported late: ROS loads slowly, and a mistake in the arguments is reported at once.
    from deformable_manipulation.system.program import ProgramError

    with interruptible():
        try:
            _make(source, arguments)
        except ProgramError as error:
            return fail(NAME, str(error))
        except OSError as error:
            return fail(NAME, f"cannot write the pictures: {error}")
        except KeyboardInterrupt as interrupt:
            return exit_status(interrupt)
    return 0


def _complete(arguments: argparse.Namespace, source: SnapshotSource) -> None:
    """Choose what is left to the command."""
    if arguments.layout == AUTO:
        arguments.layout = SIDE_BY_SIDE if source.hides_itself else OVERLAID
    if arguments.size is None:
        arguments.size = SIZE_IN_A_ROW if arguments.layout == SIDE_BY_SIDE else SIZE
    if arguments.times is None and not arguments.video:
        arguments.times = source.middle if arguments.layout == SEPARATE else source.telling_times()


def _check(arguments: argparse.Namespace, source: SnapshotSource) -> None:
    """What would be told only after the run otherwise. Raises ValueError, OSError."""
    first, last = source.time_range
    if arguments.times is not None:
        arguments.times = sorted(set(arguments.times))
        if arguments.times[0] < first - 1e-9 or arguments.times[-1] > last + 1e-9:
            wrong = arguments.times[-1] if arguments.times[-1] > last else arguments.times[0]
            place = "after the end" if wrong > last else "before the start"
            what = "scenario" if source.frames is None else "run"
            raise ValueError(
                f"--times: {wrong:g} s is {place} of the {what}; allowed: {first:g} to {last:g} s"
            )
    if arguments.video:
        if source.frames is None:
            raise ValueError(
                "--video: only recorded runs can be filmed; record this one first: "
                f"run_scenario {arguments.source} --output DIR, then rviz_snapshot DIR --video ..."
            )
        writable_folder(arguments.video.parent)
    elif arguments.speed is not None:
        raise ValueError("--speed: needs --video FILE.mp4")
    if arguments.times is not None:
        writable_folder(arguments.output)


def _configuration(source: SnapshotSource, arguments: argparse.Namespace) -> dict:
    """RViz's configuration, as of YAML. Raises ProgramError."""
    from deformable_manipulation.pictures.scene_view import fitted, plane_of
    from deformable_manipulation.ros.rviz_view import read_configuration

    path = arguments.config or own_configuration(source.scenario, source.file)
    if path is not None:
        return read_configuration(path, arguments.view, arguments.size)
    other = rviz_configuration(source.file, source.scenario)
    configuration = read_configuration(other, arguments.view, arguments.size)
    plane = plane_of(source.scenario)
    return fitted(configuration, source.bounds(), arguments.size, plane)


def _make(source: SnapshotSource, arguments: argparse.Namespace) -> None:
    from deformable_manipulation.commands.snapshot_pictures import SnapshotPictures
    from deformable_manipulation.pictures.video_file import require_ffmpeg
    from deformable_manipulation.ros.snapshot_studio import snapshot_studio

    if arguments.video:
        require_ffmpeg()
    configuration = _configuration(source, arguments)
    leader = source.scenario.agents[source.scenario.leader_index].name
    with tempfile.TemporaryDirectory(prefix=NAME + "_") as directory:
        open_run = partial(source.open, directory)
        with snapshot_studio(open_run, leader, arguments.size, directory) as studio:
            pictures = SnapshotPictures(source, studio, configuration, arguments)
            if arguments.times:
                pictures.take(arguments.times, arguments.layout)
            if arguments.video:
                pictures.film(arguments.video, arguments.speed)

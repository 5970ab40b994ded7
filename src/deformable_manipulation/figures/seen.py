"""Tables of runs whose controllers see their obstacles, or have a map of them."""

from typing import Dict, Sequence, Tuple

from deformable_manipulation.figures.campaigns import missed
from deformable_manipulation.figures.runs import Say, run_campaign, run_scenario
from deformable_manipulation.markdown.table import millimetres, table

_CAMERA, _MAP = "rope_over_depth_camera", "fabric_over_octomap"
_RUNS: Sequence[Tuple[str, Tuple[str, ...]]] = (
    (_CAMERA, ()),
    (_CAMERA, ("camera.noise=0", "camera.holes=0", "obstacles.1.noise=0")),
    (_CAMERA, ("camera.noise=0.002", "obstacles.1.noise=0.002")),
    (_CAMERA, ("obstacles.1.noise=0",)),
    (_CAMERA, ("obstacles.1.hold=0",)),
    (_MAP, ()),
)


def measure_seen_obstacles(say: Say) -> Dict[str, str]:
    """Return the table ``seen_obstacles``."""
    rows = []
    for name, values in _RUNS:
        options = [word for value in values for word in ("--set", value)]
        found = run_scenario(name, options, say)
        rows.append(
            [
                f"`{name}`" if not values else "",
                ", ".join(f"`{value}`" for value in values) or "as it is",
                millimetres(found["min_distance"]),
                millimetres(found["offset"] + found["min_margin"]["collision"]),
                str(found["qp_relaxed"]),
            ]
        )
    header = ["", "", "lowest true distance [mm]", "lowest known distance [mm]"]
    return {"seen_obstacles": table([*header, "programs relaxed"], rows)}


def measure_seen_campaign(say: Say) -> Dict[str, str]:
    """Return the table ``campaigns_seen``."""
    options = ["--runs", "20", "--seed", "1", "--duration", "60"]
    found = run_campaign(_CAMERA, options, say)
    lowest = millimetres(found["lowest_distance"])
    rows = [[f"`{_CAMERA}`", missed(found), lowest, str(found["relaxed_programs"])]]
    header = ["", "runs that missed a limit", "lowest true distance [mm]", "programs relaxed"]
    return {"campaigns_seen": table(header, rows)}

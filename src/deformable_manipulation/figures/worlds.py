"""The table of runs whose true object another engine simulates."""

from typing import Dict, List, Sequence, Tuple

from deformable_manipulation.figures.runs import Say, run_scenario
from deformable_manipulation.figures.scenarios import FABRICS, ROPES
from deformable_manipulation.markdown.table import millimetres, table

_CAMERA = (
    "correction={}",
    "knowledge.camera_rate=15",
    "knowledge.camera_noise=0.005",
    "knowledge.camera_delay=0.1",
    "knowledge.camera_hidden=0.3",
)
# What the true object is, beside the assumed one: factors of stiffness and density.
_MATERIALS: Tuple[Tuple[str, float, float], ...] = (
    ("as assumed", 1.0, 1.0),
    ("20 % softer and heavier", 0.8, 1.2),
)


def measure_ropes(say: Say) -> Dict[str, str]:
    """Return the table ``other_world``."""
    rows = [
        _row(name, *material, camera=camera, say=say)
        for name in ROPES
        for material in _MATERIALS
        for camera in (False, True)
    ]
    return {"other_world": _table(rows)}


def measure_fabrics(say: Say) -> Dict[str, str]:
    """Return the table ``other_world_fabric``."""
    rows = [
        _row(name, *material, camera=False, say=say) for name in FABRICS for material in _MATERIALS
    ]
    return {"other_world_fabric": _table(rows)}


def _row(
    name: str, material: str, stiffness: float, density: float, camera: bool, say: Say
) -> List[str]:
    sets = [f"knowledge.stiffness_factor={stiffness}", f"knowledge.density_factor={density}"]
    sets = [each for each in sets if not each.endswith("=1.0")] + list(_CAMERA if camera else ())
    options = ["--world", "mujoco"]
    for each in sets:
        options += ["--set", each]
    summary = run_scenario(name, options, say)
    required = summary["offset"]
    lacking = max(0.0, required - summary["min_distance"])
    return [
        f"`{name}`",
        material,
        "yes" if camera else "no",
        millimetres(summary["min_model_distance"]),
        millimetres(summary["min_distance"]),
        f"{millimetres(required, 0)} is enough" if not lacking else millimetres(required + lacking),
    ]


def _table(rows: Sequence[Sequence[str]]) -> str:
    header = ["scenario", "true object", "corrected", "model's lowest distance [mm]"]
    return table([*header, "true one [mm]", "`offset` needed [mm]"], rows)

"""The subject ``distance`` measures what it says, on small obstacles."""

from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation.benchmarks import distance, distance_new_cloud, distance_seen
from deformable_manipulation.benchmarks.subject import Request


@pytest.fixture(scope="module")
def tables():
    patch = pytest.MonkeyPatch()
    patch.setattr(distance, "QUICK_FACES", (12, 200))
    patch.setattr(distance, "CELLS", (3, 7))
    patch.setattr(distance, "NUMBERS_OF_COPIES", (1, 13))
    patch.setattr(distance_seen, "QUICK_POINTS", (2000,))
    patch.setattr(distance_seen, "SPACING", 0.1)
    patch.setattr(distance_new_cloud, "QUICK_POINTS", 2000)
    said = []
    made = distance.measure_tables(Request(True, Path("/nowhere"), said.append))
    patch.undo()
    assert said
    return {table.name: table for table in made}


def test_every_table_has_rows_of_positive_times(tables):
    names = {"planar", "meshes", "build", "growth", "seen", "seen_build", "new_cloud"}
    assert set(tables) == names
    for table in tables.values():
        assert table.rows
        for row in table.rows:
            assert set(row) >= {column.key for column in table.columns}
            assert (
                row.get("median_us", 1.0) >= row.get("minimum_us", 0.0) > 0.0 or "build_ms" in row
            )


def test_a_cloud_that_was_made_ready_is_used_at_once(tables):
    for row in tables["new_cloud"].rows:
        steps = [value for key, value in row.items() if key.endswith("_ms")]
        assert len(steps) == 7 and min(steps) > 0.0


def test_all_kinds_of_obstacles_are_there(tables):
    names = {row["obstacle"].partition(",")[0] for row in tables["seen"].rows}
    assert names == {"cloud", "voxels", "field", "box", "cylinder"}
    assert {row["obstacle"].partition(",")[0] for row in tables["seen_build"].rows} == names


def test_the_libraries_find_about_the_same_distances(tables):
    """SciPy's are those of the object's vertices, which are not nearer than its elements."""
    rows = [row for row in tables["seen"].rows if row["obstacle"].startswith("cloud")]
    for case in {row["case"] for row in rows}:
        own, _, rival = (row["distance"] for row in rows if row["case"] == case)
        assert own - 1e-6 <= rival <= own + 0.1
    planar = [row["distance"] for row in tables["planar"].rows]
    assert np.ptp(planar) < 1e-9

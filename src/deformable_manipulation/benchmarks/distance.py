"""The subject ``distance``: minimum distances of all copies, beside other libraries."""

from typing import List

from deformable_manipulation import _distance
from deformable_manipulation.benchmarks.distance_cases import ball, fabric, hill, rope
from deformable_manipulation.benchmarks.distance_new_cloud import measure_new_clouds
from deformable_manipulation.benchmarks.distance_rivals import (
    FclMesh,
    ShapelyPolygon,
    TrimeshVertices,
)
from deformable_manipulation.benchmarks.distance_seen import measure_seen
from deformable_manipulation.benchmarks.distance_timing import TIMES, built, own_calls, timed
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table

COPIES = 13
FACES = (12, 10_000, 100_000, 1_000_000)
QUICK_FACES = (12, 10_000)
HEIGHTS = {"outside": 1.3, "crossing": 0.8}  # m, of the fabric over the obstacle's middle
CELLS = (7, 14, 28, 56)
NUMBERS_OF_COPIES = (1, 4, 13, 28)
MOST_FOR_TRIMESH = 150_000  # faces: its candidates for a million do not fit into 24 GB

PLANAR_COLUMNS = (
    (Column("what", "what is called"),)
    + TIMES
    + (Column("distance", "lowest distance [m]", ".6f"),)
)
MESH_COLUMNS = (Column("faces", "faces", "d"), Column("case", "fabric")) + PLANAR_COLUMNS
BUILD_COLUMNS = (
    Column("faces", "faces", "d"),
    Column("build_ms", "built in [ms]", ".1f"),
    Column("memory_mb", "memory [MB]", ".0f"),
)
GROWTH_COLUMNS = (
    Column("faces", "faces", "d"),
    Column("particles", "particles", "d"),
    Column("copies", "copies", "d"),
) + TIMES
NOTES = (
    "a call: all copies at one time, with witness points; the object moves 1 mm from call to call",
    "minimum: one feature of each copy; features: and all of copy 0 up to 0.1 m farther",
    "this package's distances are signed, those of the libraries are not: 0 where the object "
    "crosses the obstacle, and within it the distance to its surface or 0",
    "Trimesh is not asked for a million faces: what it looks through does not fit into 24 GB",
)


def measure_tables(request: Request) -> List[Table]:
    """Time this package and the libraries on the same objects and obstacles."""
    return [
        _planar(request),
        *_meshes(request),
        _growth(request),
        *measure_seen(request),
        *measure_new_clouds(request),
    ]


def _planar(request: Request) -> Table:
    title = f"Polyline of 45 points, polygon of 86 corners, {COPIES} copies, one thread"
    table = Table("planar", title, PLANAR_COLUMNS, notes=list(NOTES))
    body = rope(COPIES)
    obstacle = _distance.PlanarObstacle(hill(), "yz")
    candidates = own_calls(obstacle, None) + [(ShapelyPolygon.name, ShapelyPolygon(hill()))]
    for name, call in candidates:
        request.say(f"polygon, {name}")
        table.rows.append({"what": name, **timed(call, body, request)})
    return table


def _meshes(request: Request) -> List[Table]:
    title = f"Fabric of 225 particles and 392 triangles, {COPIES} copies, one thread"
    times = Table("meshes", title, MESH_COLUMNS, notes=list(NOTES))
    memory_note = "memory: of this process, more than before"
    builds = Table("build", "Making a mesh an obstacle", BUILD_COLUMNS, notes=[memory_note])
    for faces in QUICK_FACES if request.quick else FACES:
        mesh = ball(faces)
        faces = len(mesh[1])
        request.say(f"{faces} faces, build")
        obstacle, row = built(_distance.MeshObstacle, *mesh)
        builds.rows.append({"faces": faces, **row})
        for case, height in HEIGHTS.items():
            body = fabric(COPIES, height=height)
            candidates = own_calls(obstacle, body.triangles)
            candidates.append((FclMesh.name, FclMesh(mesh[0], mesh[1], body.triangles)))
            if faces <= MOST_FOR_TRIMESH:
                candidates.append((TrimeshVertices.name, TrimeshVertices(*mesh)))
            for name, call in candidates:
                request.say(f"{faces} faces, {case}, {name}")
                labels = {"faces": faces, "case": case, "what": name}
                times.rows.append({**labels, **timed(call, body, request)})
    return [times, builds]


def _growth(request: Request) -> Table:
    table = Table("growth", "Minimum alone, fabric outside a mesh", GROWTH_COLUMNS)
    faces = QUICK_FACES[-1] if request.quick else FACES[2]
    mesh = ball(faces)
    obstacle = _distance.MeshObstacle(*mesh)
    sizes = [(cells, COPIES) for cells in CELLS]
    sizes += [(CELLS[1], copies) for copies in NUMBERS_OF_COPIES if copies != COPIES]
    for cells, copies in sizes:
        body = fabric(copies, cells)
        particles = body.states.shape[2]
        request.say(f"{particles} particles, {copies} copies")
        labels = {"faces": len(mesh[1]), "particles": particles, "copies": copies}
        call = own_calls(obstacle, body.triangles)[0][1]
        table.rows.append({**labels, **timed(call, body, request)})
    return table

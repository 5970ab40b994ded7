import os

import numpy as np
import pytest
import trimesh
from mesh_reference import cube

from deformable_manipulation.geometry import mesh_files
from deformable_manipulation.geometry.mesh_files import MeshError, read_mesh, scaled_mesh
from deformable_manipulation.scenario.spec import MeshObstacle

OBJ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 5 5\nv 0 1 0\nf 1 2 3\nf 1 3 5\n"


@pytest.fixture
def write(tmp_path):
    def write(content, name="mesh.obj"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "off", "glb"])
def test_formats(tmp_path, suffix):
    path = tmp_path / "cube.{}".format(suffix)
    trimesh.Trimesh(*cube((0, 0, 0), (1, 2, 4)), process=False).export(path)
    vertices, triangles = read_mesh(path)
    assert vertices.shape == (8, 3) and triangles.shape == (12, 3)
    mesh = trimesh.Trimesh(vertices, triangles, process=False)
    assert mesh.is_watertight and abs(mesh.volume) == pytest.approx(8.0)
    assert np.ptp(vertices, axis=0).tolist() == [1.0, 2.0, 4.0]


def test_vertices_keep_their_order_and_unused_ones_go(write):
    vertices, triangles = read_mesh(write(OBJ))
    assert vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert triangles.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_texture_seams_are_closed_and_materials_not_read(write):
    text = "mtllib /dev/zero\nvt 0 0\nvt 1 1\n" + OBJ.replace("f 1 2 3", "f 1/1 2/1 3/1").replace(
        "f 1 3 5", "f 1/2 3/2 5/2"
    )
    vertices, triangles = read_mesh(write(text))
    assert len(vertices) == 4 and len(np.unique(triangles)) == 4


def test_a_scene_is_merged_where_its_parts_are(tmp_path):
    scene = trimesh.Scene()
    box = trimesh.Trimesh(*cube(), process=False)
    for x in (0.0, 5.0):
        scene.add_geometry(box, transform=trimesh.transformations.translation_matrix([x, 0, 0]))
    scene.export(tmp_path / "scene.glb")
    vertices, triangles = read_mesh(tmp_path / "scene.glb")
    assert len(triangles) == 24
    assert np.ptp(vertices, axis=0) == pytest.approx([6.0, 1.0, 1.0])


def test_scale_of_an_obstacle(write):
    spec = MeshObstacle("tile", str(write(OBJ)), scale=(2.0, 0.5, -1.0))
    assert scaled_mesh(spec)[0].max(axis=0).tolist() == [2.0, 0.5, 0.0]


@pytest.mark.parametrize(
    "content, name, reason",
    [
        ("", "mesh.obj", "is empty"),
        ("garbage", "mesh.obj", "no triangles|no mesh"),
        ("garbage", "mesh.stl", "does not begin with 'solid', and it is too short"),
        ("garbage", "mesh.ply", "no PLY file, which begins with a line 'ply'"),
        ("garbage", "mesh.off", "line 1: 'garbage' is no header of an OFF file"),
        ("garbage", "mesh.glb", "no GLB file, which begins with 'glTF'"),
        ("garbage", "mesh.gltf", "its JSON is broken"),
        ("garbage", "mesh.dae", "it is no XML"),
        ("garbage", "mesh.3mf", "it is no ZIP archive"),
        ("garbage", "mesh.obj.gz", "it is no gzip file"),
        (OBJ, "mesh.txt", "'txt' is no format"),
        (OBJ, "mesh", "'' is no format"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "mesh.obj", "no triangles"),
        (OBJ.replace("v 1 0 0", "v nan 0 0"), "mesh.obj", "vertex 1"),
        (OBJ.replace("v 1 0 0", "v 2e6 0 0"), "mesh.obj", r"vertex 1 is \(2e\+06, 0, 0\)"),
        (
            OBJ.replace("f 1 2 3", "f 1 2 99"),
            "mesh.obj",
            "line 6: a face names vertex 99, and there are 5",
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n",
            "cloud.ply",
            "no triangles|no mesh",
        ),
    ],
)
def test_files_that_are_no_mesh(write, content, name, reason):
    path = write(content, name)
    with pytest.raises(MeshError, match=reason) as caught:
        read_mesh(path)
    assert str(path) in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "face", ["f 0 1 2", "f 1 0 2", "f 1/1 2/1 0/1\r", " f 1 2 00", "f 1//1 2//1 0//1 "]
)
def test_obj_files_count_from_1(write, face):
    with pytest.raises(MeshError, match="a face names vertex 0; OBJ counts vertices from 1"):
        read_mesh(write(OBJ + face + "\n"))


@pytest.mark.parametrize("line", ["# f 0 1 2", "s 0", "f 1 2 3 5"])
def test_zeros_of_obj_files_that_are_no_vertices(write, line):
    assert len(read_mesh(write(OBJ + line + "\n"))[1]) >= 2


@pytest.mark.parametrize("suffix", ["stl", "ply", "off", "obj", "dae", "3mf", "gltf", "glb", "gz"])
def test_what_a_library_says_of_a_broken_file_is_not_passed_on(write, capfd, suffix):
    path = write(bytes(range(256)) * 4, "noise." + suffix)
    with pytest.raises(MeshError) as caught:
        read_mesh(path)
    message = str(caught.value)
    assert message.startswith(str(path) + ": ")
    assert "module" not in message and "Traceback" not in message and "\n" not in message
    assert capfd.readouterr() == ("", "")


def test_files_that_are_none(tmp_path):
    os.mkfifo(tmp_path / "pipe.obj")
    (tmp_path / "zero.obj").symlink_to("/dev/zero")
    for name in ("pipe.obj", "zero.obj", "missing.obj", "."):
        with pytest.raises(MeshError, match="cannot be read|is not a regular file"):
            read_mesh(tmp_path / name)


def test_a_huge_file(write, monkeypatch):
    monkeypatch.setattr(mesh_files, "LARGEST_FILE", 10)
    with pytest.raises(MeshError, match="more than 10 bytes"):
        read_mesh(write(OBJ))


def test_triangles_without_area_are_no_mesh(tmp_path):
    path = tmp_path / "line.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    with pytest.raises(MeshError, match=r"line\.obj: no triangle in it has an area"):
        read_mesh(path)

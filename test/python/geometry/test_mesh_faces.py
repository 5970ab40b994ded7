"""Faces of more than three corners: what files hold, and what becomes of it."""

import gzip
import struct
import zipfile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from deformable_manipulation.geometry.mesh_files import MeshError, read_mended_mesh, read_mesh
from deformable_manipulation.mesh_formats.faces import triangulated

# The outline of an L, its concave corner fourth, and the prism above it.
OUTLINE = ((0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3))
PRISM = [(*corner, z) for z in (0, 1) for corner in OUTLINE]
SIDES = [(i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i) for i in range(6)]
FACES = [(2, 1, 0, 5, 4, 3), (8, 9, 10, 11, 6, 7), *SIDES]


def volume(vertices, triangles):
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0


def area(vertices, triangles):
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def text_of(rows):
    return "\n".join(" ".join(map(str, row)) for row in rows) + "\n"


def obj_text():
    faces = [("f", *(index + 1 for index in face)) for face in FACES]
    return text_of([("v", *vertex) for vertex in PRISM]) + text_of(faces)


def off_text():
    counted = [(len(face), *face, 255, 0, 0) for face in FACES]
    return "OFF # prism\n12 8 0\n" + text_of(PRISM) + text_of(counted)


def ply_header(form):
    return (
        "ply\nformat {} 1.0\nelement vertex 12\nproperty float x\nproperty float y\n"
        "property float z\nelement face 8\nproperty list uchar int vertex_indices\nend_header\n"
    ).format(form)


def ply_text():
    return ply_header("ascii") + text_of(PRISM) + text_of((len(face), *face) for face in FACES)


def ply_bytes(order, form):
    vertices = b"".join(struct.pack(order + "3f", *vertex) for vertex in PRISM)
    faces = b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in FACES)
    return ply_header(form).encode() + vertices + faces


def collada_text():
    positions = " ".join(str(c) for vertex in PRISM for c in vertex)
    counts = " ".join(str(len(face)) for face in FACES)
    corners = " ".join(f"{index} 0" for face in FACES for index in face)
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g" name="prism"><mesh>
<source id="p"><float_array id="a" count="36">{positions}</float_array>
<technique_common><accessor source="#a" count="12" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="8"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="NORMAL" source="#n" offset="1"/>
<vcount>{counts}</vcount><p>{corners}</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node><translate>100 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>
<node><translate>0 0 50</translate><instance_geometry url="#g"/></node></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


CONTENTS = {
    "prism.obj": obj_text(),
    "prism.off": off_text(),
    "prism.ply": ply_text(),
    "little.ply": ply_bytes("<", "binary_little_endian"),
    "big.ply": ply_bytes(">", "binary_big_endian"),
    "windows.obj": "\ufeff" + obj_text().replace("\n", "\r\n"),
}


@pytest.fixture
def write(tmp_path):
    def write(content, name):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


@pytest.mark.parametrize("name", CONTENTS)
def test_concave_faces_stay_within_their_outline(write, name):
    vertices, triangles = read_mesh(write(CONTENTS[name], name))
    assert vertices.tolist() == [list(vertex) for vertex in PRISM]
    assert volume(vertices, triangles) == pytest.approx(5.0)
    assert area(vertices, triangles) == pytest.approx(2 * 5 + 12)


def test_packed_files(write, tmp_path):
    vertices, triangles = read_mesh(write(gzip.compress(obj_text().encode()), "prism.obj.gz"))
    assert volume(vertices, triangles) == pytest.approx(5.0)
    with zipfile.ZipFile(tmp_path / "prism.zip", "w") as archive:
        archive.writestr("readme.txt", "a prism")
        archive.writestr("models/prism.off", off_text())
    assert volume(*read_mesh(tmp_path / "prism.zip")) == pytest.approx(5.0)


def test_several_meshes_in_an_archive_are_refused_by_name(tmp_path):
    with zipfile.ZipFile(tmp_path / "two.zip", "w") as archive:
        archive.writestr("a.off", off_text())
        archive.writestr("b.obj", obj_text())
    with pytest.raises(MeshError, match=r"has 2 \(a.off, b.obj\); unpack it and name one"):
        read_mesh(tmp_path / "two.zip")


def test_collada_is_in_metres_and_placed_by_its_nodes(write):
    vertices, triangles = read_mesh(write(collada_text(), "prism.dae"))
    assert volume(vertices, triangles) == pytest.approx(2 * 5e-6)
    assert vertices.min(axis=0) == pytest.approx([0.97, 0.0, 0.5])
    assert vertices.max(axis=0) == pytest.approx([1.0, 0.06, 0.51])


@pytest.mark.parametrize(
    "part, wrong, reason",
    [
        ('meter="0.01"', 'meter="none"', "its unit is meter='none'"),
        ('url="#g"', 'url="#h"', "<instance_geometry> refers to '#h', which is not in the file"),
        ("100 0 0", "100 0", "<translate> holds 2 numbers, not 3"),
        ("100 0 0", "100 0 zero", "<translate> holds '100 0 zero', not numbers"),
        ("<p>2 0", "<p>99 0", "geometry 'prism': <polylist> name vertex 99"),
        ("<vcount>6", "<vcount>60", "<vcount> tells of 90 corners, and <p> holds 36"),
        ("</scene>", "", "it is no XML, or broken: mismatched tag: line"),
    ],
)
def test_reasons_of_collada(write, part, wrong, reason):
    assert part in collada_text()
    path = write(collada_text().replace(part, wrong), "prism.dae")
    with pytest.raises(MeshError, match=reason):
        read_mesh(path)


def three_mf(tmp_path, unit="inch", transform="2 0 0 0 1 0 0 0 1 10 0 0"):
    triangles = [(f[0], f[k], f[k + 1]) for f in SIDES for k in (1, 2)]
    triangles += [(2, 1, 0), (2, 0, 3), (3, 0, 5), (3, 5, 4)]
    triangles += [(8, 6, 7), (9, 6, 8), (9, 11, 6), (10, 11, 9)]
    rows = ['<vertex x="{}" y="{}" z="{}"/>'.format(*vertex) for vertex in PRISM]
    faces = ['<triangle v1="{}" v2="{}" v3="{}"/>'.format(*each) for each in triangles]
    model = (
        f'<model unit="{unit}" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">'
        f'<resources><object id="1"><mesh><vertices>{"".join(rows)}</vertices>'
        f"<triangles>{''.join(faces)}</triangles></mesh></object>"
        f'<object id="2"><components><component objectid="1" transform="{transform}"/>'
        '<component objectid="1"/></components></object></resources>'
        '<build><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 100"/></build></model>'
    )
    with zipfile.ZipFile(tmp_path / "prisms.3mf", "w") as archive:
        archive.writestr("3D/3dmodel.model", model)
    return tmp_path / "prisms.3mf"


def test_3mf_is_in_metres_and_placed_by_its_components(tmp_path):
    vertices, triangles = read_mesh(three_mf(tmp_path))
    assert len(vertices) == 24
    assert volume(vertices, triangles) == pytest.approx(3 * 5 * 0.0254**3)
    assert vertices.min(axis=0) == pytest.approx([0.0, 0.0, 2.54])
    assert vertices.max(axis=0) == pytest.approx(0.0254 * np.array([16, 3, 101]))


def test_reasons_of_3mf(tmp_path):
    with pytest.raises(MeshError, match="its unit is 'parsec'; allowed: micron"):
        read_mesh(three_mf(tmp_path, unit="parsec"))
    with pytest.raises(MeshError, match="a transform has 3 numbers, not 12"):
        read_mesh(three_mf(tmp_path, transform="1 2 3"))


def test_relative_indices_count_back_from_their_line(write):
    tetrahedron = "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n"
    corners = "v {0} 0 0\nv {1} 0 0\nv {0} 1 0\nv {0} 0 1\n"
    text = corners.format(0, 1) + tetrahedron + corners.format(5, 6) + tetrahedron
    vertices, triangles = read_mesh(write(text, "two.obj"))
    assert np.unique(triangles[:4]).tolist() == [0, 1, 2, 3]
    assert np.unique(triangles[4:]).tolist() == [4, 5, 6, 7]
    assert volume(vertices, triangles) == pytest.approx(2 / 6)


@pytest.mark.parametrize(
    "text, reason",
    [
        ("v 0 0 0\nv 1 0 0\nf -3 -2 -1\n", "line 3: a face names vertex -3, and only 2 vertices"),
        ("v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n", "line 2: '1 zero 0' are not the three"),
        ("v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", "line 2: '1 0' are not the three"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 c\n", "line 4: 'c' is no corner of a face"),
        ("v 0 0 0\nv 1 0 0\nl 1 2\n", "only lines or points"),
        ("v 0 0 0\nsurf 0 1 0 1 1 2\n", "free-form curves or surfaces and no faces"),
    ],
)
def test_reasons_of_obj(write, text, reason):
    with pytest.raises(MeshError, match=reason):
        read_mesh(write(text, "mesh.obj"))


@pytest.mark.parametrize(
    "part, wrong, reason",
    [
        ("12 8 0", "12 eight 0", "line 2: '12 eight 0' are not the numbers of vertices, faces"),
        ("3 1 1\n", "3 one 1\n", "line 11: '3 one 1' are not the three coordinates"),
        ("6 2 1 0", "6 2 1 99", "line 15: a face names vertex 99; the 12 vertices"),
        ("12 8 0", "12 9 0", "the file ends in face 9 of 9; it is cut off"),
        ("12 8 0", "99 8 0", "the file ends after 20 of 99 vertices"),
    ],
)
def test_reasons_of_off(write, part, wrong, reason):
    assert part in off_text()
    with pytest.raises(MeshError, match=reason):
        read_mesh(write(off_text().replace(part, wrong, 1), "mesh.off"))


def test_off_files_whose_faces_go_on_on_the_next_line(write):
    text = off_text().replace("6 2 1 0", "6 2\n1 0").replace("OFF # prism\n", "OFF")
    assert volume(*read_mesh(write(text, "mesh.off"))) == pytest.approx(5.0)


@pytest.mark.parametrize(
    "part, wrong, reason",
    [
        ("face 8", "face 9", "the file ends in element 'face' 8 of 9"),
        ("property float y\n", "", "its vertices have no property y"),
        ("property float x", "property floot x", "line 4 of its header, 'property floot x'"),
        ("\n6 2 1 0", "\n6 2 1 99", "face 0 names vertex 99; the 12 vertices"),
        ("\n6 2 1 0", "\n9 2 1 0", "line 22: '9 2 1 0 5 4 3' are not the values that the header"),
        ("\n3 1 0\n", "\n3 one 0\n", "line 12: 'one' is no number"),
    ],
)
def test_reasons_of_ply(write, part, wrong, reason):
    assert part in ply_text()
    with pytest.raises(MeshError, match=reason):
        read_mesh(write(ply_text().replace(part, wrong, 1), "mesh.ply"))


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian"])
def test_headers_that_promise_more_than_there_can_be(write, form):
    header = ply_header(form).replace("end_header", "element nothing 999999999999\nend_header")
    with pytest.raises(MeshError, match="the file ends in element 'face' 0 of 999999999999"):
        text = header.replace("face 8", "face 999999999999").replace("vertex 12", "vertex 0")
        read_mesh(write(text, "mesh.ply"))


def test_corners_that_hide_one_another_in_the_plane_of_their_face():
    vertices = np.array([(0, 0, 0), (0, -1, 0), (-1, -1, -1), (0, -1, -1)], dtype=float)
    assert len(triangulated(vertices, np.array([4]), np.arange(4))) == 2


def test_a_binary_ply_that_is_cut_off(write):
    content = ply_bytes("<", "binary_little_endian")
    with pytest.raises(MeshError, match="the file ends in element 'face' 7 of 8; it is cut off"):
        read_mesh(write(content[:-3], "mesh.ply"))


@pytest.mark.parametrize("runs", [[(0, 1, 2, 3, -1, 4, 5, 6, 7)], [(0, 1, 2, 3), (4, 5, 6, 7)]])
def test_triangle_strips_of_ply(write, runs):
    corners = [(x, y, z) for z in (0, 1) for x in (0, 1) for y in (0, 1)]
    header = ply_header("ascii").replace("vertex 12", "vertex 8")
    header = header.replace("face 8", "tristrips {}".format(len(runs)))
    text = header + text_of(corners) + text_of((len(run), *run) for run in runs)
    vertices, triangles = read_mesh(write(text, "strips.ply"))
    assert len(triangles) == 4 and area(vertices, triangles) == pytest.approx(2.0)
    normals = np.cross(*np.diff(vertices[triangles], axis=1).transpose(1, 0, 2))
    assert (normals[:, 2] == -1.0).all()


@pytest.mark.parametrize(
    "content, reason",
    [
        (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", "on line 2; it"),
        (b"solid a\nfacet\nvertex 0 0 0\nendfacet\n", "line 2: the facet that begins here has not"),
        (
            b"solid a\nfacet\nvertex 0 0 none\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n",
            "line 3: '0 0 n",
        ),
        (
            b"\0" * 80 + struct.pack("<I", 9) + b"\0" * 100,
            "tells of 9 triangles and has room for 2",
        ),
    ],
)
def test_reasons_of_stl(write, content, reason):
    with pytest.raises(MeshError, match=reason):
        read_mesh(write(content, "mesh.stl"))


def square_with_hole():
    """A face around a hole, which a bridge joins to the outline, there and back."""
    outer = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    hole = [(1, 1, 0), (1, 3, 0), (3, 3, 0), (3, 1, 0)]
    return np.array(outer + hole, dtype=float), np.array([0, 1, 2, 3, 0, 4, 5, 6, 7, 4])


@pytest.mark.parametrize("turn", range(10))
def test_faces_with_holes(turn):
    vertices, face = square_with_hole()
    triangles = triangulated(vertices, np.array([10]), np.roll(face, turn))
    assert area(vertices, triangles) == pytest.approx(12.0)
    middles = vertices[triangles].mean(axis=1)
    assert not ((middles[:, :2] > 1.0) & (middles[:, :2] < 3.0)).all(axis=1).any()


def test_corners_on_straight_sides_leave_no_flat_triangle():
    vertices = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], dtype=float)
    triangles = triangulated(vertices, np.array([5]), np.arange(5))
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    assert (np.linalg.norm(np.cross(b - a, c - a), axis=1) > 0.5).all()


@given(
    st.lists(st.floats(0.2, 1.0), min_size=4, max_size=40),
    st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda n: np.linalg.norm(n) > 0.1),
)
def test_stars_are_filled_once(radii, normal):
    """A polygon that is seen whole from its middle, in any plane."""
    angles = 2.0 * np.pi * np.arange(len(radii)) / len(radii)
    first = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first) / np.linalg.norm(normal)
    vertices = np.outer(radii * np.cos(angles), first) + np.outer(radii * np.sin(angles), second)
    triangles = triangulated(vertices, np.array([len(radii)]), np.arange(len(radii)))
    ends = np.roll(np.arange(len(radii)), -1)
    expected = 0.5 * sum(
        np.linalg.norm(np.cross(vertices[i], vertices[k])) for i, k in enumerate(ends)
    )
    assert len(triangles) == len(radii) - 2
    assert area(vertices, triangles) == pytest.approx(expected, rel=1e-9)


def test_what_comes_after_is_the_same_with_an_origin(write):
    far = text_of([("v", x + 6e5, y + 5.4e6, z) for x, y, z in PRISM]) + "".join(
        line + "\n" for line in obj_text().splitlines() if line.startswith("f")
    )
    path = write(far, "far.obj")
    with pytest.raises(MeshError, match="at most 1e.06 from the origin"):
        read_mesh(path)
    assert read_mended_mesh(path, (6e5, 5.4e6, 0.0)).vertices.tolist() == [list(v) for v in PRISM]

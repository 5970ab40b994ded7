"""glTF and GLB: what the triangles are made of, and where they are placed."""

import base64
import json
import struct

import numpy as np
import pytest

from deformable_manipulation.geometry.mesh_files import MeshError, read_mesh

FLAT = np.array([(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)])
BUFFER = (
    FLAT.astype("<f4").tobytes()  # 48 bytes
    + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    + struct.pack("<4H", 0, 1, 2, 3)  # of a fan, at 60
    + struct.pack("<4H", 0, 1, 3, 2)  # of a strip, at 68
    + struct.pack("<HH", 2, 3)  # replaced corners, at 76
    + np.array([(2, 3, 0), (0, 3, 0)], dtype="<f4").tobytes()  # by these, at 80
    + np.array([(0, 0, 0), (127, 0, 0), (127, 64, 0), (0, -127, 0)], dtype="i1").tobytes()  # at 104
)


def document(primitive=None, accessor=None, **keys):
    positions = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [
            {
                "name": "plate",
                "primitives": [primitive or {"attributes": {"POSITION": 0}, "indices": 1}],
            }
        ],
        "accessors": [
            accessor or positions,
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5123, "count": 4, "type": "SCALAR"},
            {"bufferView": 3, "componentType": 5123, "count": 4, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": begin, "byteLength": length}
            for begin, length in ((0, 48), (48, 12), (60, 8), (68, 8), (76, 4), (80, 24), (104, 12))
        ],
        "buffers": [{"byteLength": len(BUFFER), "uri": "plate%20.bin"}],
        **keys,
    }


@pytest.fixture
def read(tmp_path):
    def read(content, name="plate.gltf"):
        (tmp_path / "plate .bin").write_bytes(BUFFER)
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
        return read_mesh(path)

    return read


def area(vertices, triangles):
    """Of triangles in the xy plane, positive if they are counterclockwise."""
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    return 0.5 * np.cross(b - a, c - a)[:, 2].sum()


def glb(contents):
    text = json.dumps(contents).encode()
    text += b" " * (-len(text) % 4)
    buffer = BUFFER + b"\0" * (-len(BUFFER) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


@pytest.mark.parametrize(
    "primitive",
    [
        {"attributes": {"POSITION": 0}, "indices": 1},
        {"attributes": {"POSITION": 0}, "indices": 3, "mode": 5},
        {"attributes": {"POSITION": 0}, "indices": 2, "mode": 6},
        {"attributes": {"POSITION": 0}, "mode": 6},
    ],
)
def test_triangles_strips_and_fans(read, primitive):
    vertices, triangles = read(document(primitive))
    assert len(triangles) == 2 and area(vertices, triangles) == pytest.approx(2.0)


@pytest.mark.parametrize("where", ["file", "data", "glb"])
def test_where_the_numbers_are(read, where):
    content = document()
    if where == "data":
        encoded = base64.b64encode(BUFFER).decode()
        content["buffers"][0]["uri"] = "data:application/octet-stream;base64," + encoded
    if where == "glb":
        del content["buffers"][0]["uri"]
        assert area(*read(glb(content), "plate.glb")) == pytest.approx(2.0)
    else:
        assert area(*read(content)) == pytest.approx(2.0)


def test_sparse_accessors_replace_corners(read):
    sparse = {
        "count": 2,
        "indices": {"bufferView": 4, "componentType": 5123},
        "values": {"bufferView": 5},
    }
    accessor = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}
    vertices, triangles = read(document(accessor={**accessor, "sparse": sparse}))
    assert area(vertices, triangles) == pytest.approx(6.0)


@pytest.mark.parametrize("normalized", [False, True])
def test_quantised_corners(read, normalized):
    accessor = {"bufferView": 6, "componentType": 5120, "count": 4, "type": "VEC3"}
    vertices, _ = read(document(accessor={**accessor, "normalized": normalized}))
    factor = 1.0 / 127.0 if normalized else 1.0
    assert vertices[2] == pytest.approx(factor * np.array([127, 64, 0]))


def test_nodes_place_meshes(read):
    turn = [0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]  # x to y
    inner = {"mesh": 0, "scale": [3, 1, 1]}
    outer = {"children": [1], "rotation": turn, "translation": [10, 0, 0]}
    flat = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1]
    nodes = [outer, inner, {"mesh": 0, "matrix": flat}]
    vertices, triangles = read(document(nodes=nodes, scenes=[{"nodes": [0, 2]}]))
    assert area(vertices, triangles) == pytest.approx(3 * 2.0 + 2.0)
    assert vertices.min(axis=0) == pytest.approx([0.0, 0.0, -5.0])
    assert vertices.max(axis=0) == pytest.approx([10.0, 6.0, 0.0])


@pytest.mark.parametrize(
    "change, reason",
    [
        ({"asset": {"version": "1.0"}}, "glTF version '1.0'; export it as version 2"),
        ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "it uses KHR_draco.*without comp"),
        ({"scene": 3}, "its scene refers to 3 of 'scenes', and there are 1"),
        ({"nodes": [{"children": [0]}]}, "within one another in a circle"),
        ({"nodes": [{"mesh": 7}]}, "a node refers to 7 of 'meshes', and there are 1"),
        ({"buffers": [{"uri": "gone.bin"}]}, "mesh 'plate': its file 'gone.bin' cannot be read"),
        ({"buffers": [{"uri": "data:;base64,AAA"}]}, "a buffer in it is no base64"),
        ({"bufferViews": []}, "an accessor refers to 0 of 'bufferViews'"),
        ({"accessors": []}, "a mesh refers to 0 of 'accessors'"),
        ({"meshes": []}, "a node refers to 0 of 'meshes'"),
        ({"nodes": "none"}, "no object"),
    ],
)
def test_reasons(read, change, reason):
    with pytest.raises(MeshError, match=reason):
        read(document(**change))


@pytest.mark.parametrize(
    "accessor, reason",
    [
        ({"count": 40}, "accessor 0 needs 40 values and there are fewer"),
        ({"componentType": 1}, "accessor 0 has components of the unknown type 1"),
        ({"type": "VEC2"}, "accessor 0 is of type VEC2, not VEC3"),
        ({"count": 3}, "mesh 'plate': its triangles name vertex 3; the 3 vertices"),
    ],
)
def test_reasons_of_accessors(read, accessor, reason):
    whole = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}
    with pytest.raises(MeshError, match=reason):
        read(document(accessor={**whole, **accessor}))


def test_a_file_that_is_cut_off(read):
    content = document()
    del content["buffers"][0]["uri"]
    with pytest.raises(MeshError, match="the file ends within its chunk"):
        read(glb(content)[:-8], "plate.glb")

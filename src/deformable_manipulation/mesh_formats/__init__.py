"""File formats of triangle meshes: bytes to vertices and triangles."""

"""PointCloud2 messages of any layout, without ROS."""

from types import SimpleNamespace

import numpy as np

DATATYPES = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}


def message(points, types=("f4", "f4", "f4"), names="xyz", big=False, gap=0, rows=1, padding=0):
    """A message of points (N, K) whose fields have these types.

    Args:
        points: values by column.
        types: of numpy, without byte order.
        names: of the columns, in the order of the record.
        big: big-endian.
        gap: bytes before each field.
        rows: of the image.
        padding: bytes after each row.
    """
    order = ">" if big else "<"
    offsets, end = [], 0
    for each in types:
        offsets.append(end + gap)
        end += gap + np.dtype(each).itemsize
    layout = np.dtype(
        {
            "names": list(names),
            "formats": [order + each for each in types],
            "offsets": offsets,
            "itemsize": end,
        }
    )
    records = np.zeros(len(points), dtype=layout)
    for column, name in enumerate(names):
        records[name] = np.asarray(points)[:, column]
    width = len(points) // rows
    lines = [records[row * width : (row + 1) * width].tobytes() for row in range(rows)]
    return SimpleNamespace(
        height=rows,
        width=width,
        fields=[
            SimpleNamespace(name=name, offset=offset, datatype=DATATYPES[each], count=1)
            for name, offset, each in zip(names, offsets, types)
        ],
        is_bigendian=big,
        point_step=end,
        row_step=width * end + padding,
        data=b"".join(line + bytes(padding) for line in lines),
    )

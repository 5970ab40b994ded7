"""Clouds of points: reading them from files."""

import io
from pathlib import Path
from typing import Callable, Dict, Sequence

import numpy as np

from deformable_manipulation.cloud_formats import pcd, text
from deformable_manipulation.mesh_formats import ply
from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.system.text_files import TextFileError, read_bytes

LARGEST_COORDINATE = 1e6  # m
LARGEST_FILE = 4_000_000_000  # bytes, a hundred million points
FORMATS = "PCD, PLY, XYZ (text with x y z on each line) and NPY"
_NO_ORIGIN = (0.0, 0.0, 0.0)


class CloudError(ValueError):
    """Points cannot be read, or there are none; the message says why, on one line."""


def read_cloud(path, origin: Sequence[float] = _NO_ORIGIN) -> np.ndarray:
    """Read points of one of FORMATS. Those that are not finite, as of a depth image, are left out.

    Args:
        path: of the file.
        origin: (3,) m, what is taken off all coordinates.

    Returns:
        (N, 3) m, N >= 1, in the precision of the file.

    Raises:
        CloudError: the file, which it names, cannot be read, is no regular file, has more than
            LARGEST_FILE bytes, is of no known format or broken, has no finite point, or one
            beyond LARGEST_COORDINATE from the origin.
    """
    try:
        data = read_bytes(path, LARGEST_FILE)
    except TextFileError as error:
        raise CloudError("{} {}".format(path, error)) from error
    if not data:
        raise CloudError("{} is empty".format(path))
    suffix = Path(str(path)).suffix.lower().lstrip(".")
    if suffix not in _READERS:
        raise CloudError(
            "{}: '{}' is no format of points that can be read; formats allowed: {}".format(
                path, suffix, FORMATS
            )
        )
    try:
        points = _READERS[suffix](data)
    except FormatError as error:
        raise CloudError("{}: {}".format(path, " ".join(str(error).split()))) from error
    except Exception as error:  # a broken file may break a rule that no reader thought of
        raise CloudError("{} is broken: its points cannot be read".format(path)) from error
    return _checked(path, points, np.asarray(origin, dtype=float))


def _checked(path, points: np.ndarray, origin: np.ndarray) -> np.ndarray:
    finite = points[np.isfinite(points).all(axis=1)]
    if not len(finite):
        raise CloudError(
            "{}: there is no point in it{}".format(
                path, ", only {} that are not finite".format(len(points)) if len(points) else ""
            )
        )
    if origin.any():
        finite = finite - origin
    farthest = int(np.argmax(np.abs(finite).max(axis=1)))
    if np.abs(finite[farthest]).max() > LARGEST_COORDINATE:
        raise CloudError(
            "{}: a point is at ({:g}, {:g}, {:g}); coordinates must be at most {:g} from the "
            "origin".format(path, *finite[farthest], LARGEST_COORDINATE)
        )
    return finite


def _read_npy(data: bytes) -> np.ndarray:
    try:
        points = np.load(io.BytesIO(data), allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise FormatError("it is no array of numbers, or it is broken") from error
    if not isinstance(points, np.ndarray) or points.dtype.kind not in "fiu":
        raise FormatError("it is no array of numbers")
    if points.ndim < 2 or points.shape[-1] < 3:
        sizes = " x ".join(map(str, points.shape)) or "a single number"
        raise FormatError("its size is {}; it must be N x 3, a row per point".format(sizes))
    return points.reshape(-1, points.shape[-1])[:, :3]


_READERS: Dict[str, Callable[[bytes], np.ndarray]] = {
    "pcd": pcd.read,
    "ply": ply.read_points,
    "npy": _read_npy,
    **dict.fromkeys(("xyz", "txt", "csv", "pts"), text.read),
}

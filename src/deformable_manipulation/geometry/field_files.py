"""Grids of signed distances: reading them from files."""

from typing import NamedTuple

import numpy as np

from deformable_manipulation.system.text_files import TextFileError, open_regular

LARGEST_COORDINATE = 1e6  # m
MOST_VALUES = 300_000_000
KEYS = ("distances", "origin", "spacing")


class FieldError(ValueError):
    """A field cannot be read; the message says why, on one line."""


class Field(NamedTuple):
    """Signed distances at ``origin + spacing * (i, j, k)``."""

    distances: np.ndarray  # (X, Y, Z) m, float32, all finite
    origin: np.ndarray  # (3,) m
    spacing: np.ndarray  # (3,) m
    unknown: int  # how many were no numbers


def read_field(path, is_free_unknown: bool) -> Field:
    """Read an archive of NumPy with the arrays of KEYS; ``spacing`` is one number or three.

    Distances that are no numbers are unknown. As free space, they become the largest that there
    is; as occupied space, minus one spacing.

    Args:
        path: of the file.
        is_free_unknown: what is unknown counts as.

    Raises:
        FieldError: the file, which it names, cannot be read, is no such archive, or its arrays are
            not right.
    """
    try:
        with open_regular(path) as file, np.load(file, allow_pickle=False) as arrays:
            missing = [key for key in KEYS if key not in arrays.files]
            if missing:
                raise FieldError(
                    "{}: it has no array {}; the arrays of a field are {}".format(
                        path, ", ".join(missing), ", ".join(KEYS)
                    )
                )
            distances, origin, spacing = (arrays[key] for key in KEYS)
    except OSError as error:
        raise FieldError("{} cannot be read: {}".format(path, error.strerror or error)) from error
    except TextFileError as error:
        raise FieldError("{} {}".format(path, error)) from error
    except FieldError:
        raise
    except Exception as error:  # a broken file may break a rule that NumPy did not think of
        text = "{} is no archive (.npz) of NumPy, or it is broken"
        raise FieldError(text.format(path)) from error
    fault = _fault(distances, origin, spacing)
    if fault:
        raise FieldError("{}: {}".format(path, fault))
    return filled(distances, origin, np.broadcast_to(spacing, 3), is_free_unknown)


def _fault(distances: np.ndarray, origin: np.ndarray, spacing: np.ndarray) -> str:
    """What is wrong with the arrays; empty if nothing is."""
    for key, array in zip(KEYS, (distances, origin, spacing)):
        if not isinstance(array, np.ndarray) or array.dtype.kind not in "fiu":
            return "{} holds no numbers".format(key)
    if distances.ndim != 3 or min(distances.shape) < 2 or distances.size > MOST_VALUES:
        return "the size of distances is {}; it must be X x Y x Z, each 2 or more".format(
            " x ".join(map(str, distances.shape)) or "a single number"
        )
    if origin.shape != (3,) or not (np.abs(origin) <= LARGEST_COORDINATE).all():
        return "origin must be three finite numbers of at most {:g} m".format(LARGEST_COORDINATE)
    if spacing.shape not in ((), (1,), (3,)) or not ((spacing >= 1e-6) & (spacing <= 1e6)).all():
        return "spacing must be one number, or three, from 1e-6 to 1e6 m"
    known = distances[~np.isnan(distances)]
    if not len(known):
        return "none of its distances is a number"
    if not (np.abs(known) <= LARGEST_COORDINATE).all():
        return "distances must be at most {:g} m; those that are not known, nan".format(
            LARGEST_COORDINATE
        )
    return ""


def filled(distances: np.ndarray, origin: np.ndarray, spacing: np.ndarray, is_free: bool) -> Field:
    """A field with something in the place of what is unknown, see :func:`read_field`."""
    unknown = np.isnan(distances)
    if unknown.any():
        substitute = np.nanmax(distances) if is_free else -np.max(spacing)
        distances = np.where(unknown, substitute, distances)
    return Field(
        distances.astype(np.float32),
        origin.astype(float),
        spacing.astype(float),
        int(np.count_nonzero(unknown)),
    )

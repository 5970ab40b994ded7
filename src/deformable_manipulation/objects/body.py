"""Objects as the C++ core simulates them."""

from typing import Sequence

from deformable_manipulation.objects.spec import ObjectSpec

GRAVITY = (0.0, 0.0, -9.81)  # m/s^2
JOINT_SOLVER = "direct"


def make_body(spec: ObjectSpec, gravity: Sequence[float] = GRAVITY, solver: str = JOINT_SOLVER):
    """An object, undeformed and held nowhere.

    Args:
        spec: the object.
        gravity: (3,) [m/s^2].
        solver: of its joints, if it has any: ``simulation.solver``.

    Returns:
        The ``_pbd.Body`` of its kind.

    Raises:
        _pbd.ParameterError: a parameter is out of range.
    """
    # Imported late: the compiled core is not there yet when the build reads the declarations.
    from deformable_manipulation import _pbd

    return _pbd.make_body(spec.to_mapping(), {"gravity": list(gravity), "solver": solver})

"""MuJoCo, if it is installed."""

from deformable_manipulation.worlds.errors import WorldError


def load_engine():
    """The module ``mujoco``.

    Raises:
        WorldError: it is not installed.
    """
    try:
        import mujoco
    except ImportError as error:
        raise WorldError(
            "knowledge.world: mujoco needs the Python package MuJoCo, which cannot be imported "
            f"({error}). Install it: pip install 'mujoco==3.17.0', or in a checkout scripts/setup"
        ) from error
    # Or else it writes a file into the current folder; what it warns of is in MjData.warning, too.
    mujoco.set_mju_user_warning(lambda text: None)
    return mujoco


def require_stable(data, time: float) -> None:
    """Raise RuntimeError where the engine has broken down, which it only logs.

    Args:
        data: ``mujoco.MjData``.
        time: [s] since the start, for the text.
    """
    if any(warning.number for warning in data.warning):
        raise RuntimeError(f"MuJoCo's simulation of the object became unstable at {time:.3f} s")

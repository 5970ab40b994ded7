"""Where files are: this package's share directory, and files of ROS packages."""

from pathlib import Path
from typing import Optional

PACKAGE = "deformable_manipulation"
_PACKAGE_SCHEME = "package://"


def package_share_directory() -> Path:
    """The directory that holds ``config/``: of the checkout, or ``share/`` of an install space.

    Raises FileNotFoundError if there is neither and the ROS package path does not know it.
    """
    for parent in Path(__file__).resolve().parents:
        for candidate in (parent, parent / "share" / PACKAGE):
            if _is_this_package(candidate):
                return candidate
    directory = ros_package(PACKAGE)
    if directory is None:
        raise FileNotFoundError(
            "the files of package {} are not found; source the workspace's setup.bash".format(
                PACKAGE
            )
        )
    return directory


def _is_this_package(directory: Path) -> bool:
    manifest = directory / "package.xml"
    return manifest.is_file() and "<name>{}</name>".format(PACKAGE) in manifest.read_text(
        encoding="utf-8"
    )


def ros_package(name: str) -> Optional[Path]:
    """The directory of a ROS package, None without ROS or without that package."""
    try:
        import rospkg
    except ImportError:
        return None
    try:
        return Path(rospkg.RosPack().get_path(name))
    except rospkg.ResourceNotFound:
        return None


def resolve_file(text: str, directory: Path) -> Path:
    """The path that a scenario's text means: relative to ``directory``, absolute or package://.

    Raises FileNotFoundError if the package is unknown; the file itself need not exist.
    """
    if not text.startswith(_PACKAGE_SCHEME):
        return directory / text
    package, _, rest = text[len(_PACKAGE_SCHEME) :].partition("/")
    root = package_share_directory() if package == PACKAGE else ros_package(package)
    if root is None:
        raise FileNotFoundError("there is no ROS package '{}'".format(package))
    return root / rest

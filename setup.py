"""Installs the Python package: under ROS by catkin, without ROS by pip.

By pip, the C++ modules are built too, the commands that need no ROS become console commands, and
the package's files go to share/, as in an install space.
"""

import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

from setuptools import Extension, find_packages, setup
from setuptools.command.build_ext import build_ext

PACKAGE = "deformable_manipulation"
FOLDER = Path(__file__).resolve().parent
MODULES = ("_control", "_distance", "_pbd")
COMMANDS = (
    "benchmark",
    "check_scenario",
    "identify",
    "new_scenario",
    "plot_run",
    "replay",
    "run_campaign",
    "run_scenario",
    "validate",
)
DATA = (".csv", ".launch", ".obj", ".rviz", ".yaml")


class CMakeBuild(build_ext):
    """Builds the C++ modules by CMakeLists.txt, without ROS."""

    def build_extensions(self):
        """Build all of them beside the Python files."""
        output = Path(self.get_ext_fullpath(self.extensions[0].name)).resolve().parent
        folder = str(Path(self.build_temp).resolve())
        options = {
            PACKAGE + "_WITH_ROS": "OFF",
            "CMAKE_LIBRARY_OUTPUT_DIRECTORY": output,
            "PYTHON_EXECUTABLE": sys.executable,
        }
        definitions = ["-D{}={}".format(*option) for option in options.items()]
        subprocess.check_call(["cmake", "-S", str(FOLDER), "-B", folder, *definitions])
        cores = str(len(os.sched_getaffinity(0)))
        subprocess.check_call(["cmake", "--build", folder, "--parallel", cores])


def requirements():
    """Lists of requirements by the name of their extra, ``""`` for what is always needed."""
    lists = {"": []}
    files = {"pip-requirements.txt": ">=", "pip-requirements-focal.txt": "<"}
    for file, comparison in files.items():
        extra = ""
        for line in (FOLDER / "scripts" / file).read_text(encoding="utf-8").splitlines():
            heading = re.match(r"# \[(\w+)\]", line)
            if heading:
                extra = heading.group(1)
            elif line and not line.startswith("#"):
                marked = '{}; python_version {} "3.11"'.format(line, comparison)
                lists.setdefault(extra, []).append(marked)
    return lists


def data_files():
    """The files that ``package_share_directory`` finds, by their folder below the prefix."""
    files = [FOLDER / "package.xml"]
    for folder in ("config", "launch", "rviz"):
        files += [path for path in (FOLDER / folder).rglob("*") if path.suffix in DATA]
    by_folder = {}
    for path in sorted(files):
        relative = path.relative_to(FOLDER)
        share = str(Path("share", PACKAGE, relative.parent))
        by_folder.setdefault(share, []).append(str(relative))
    return list(by_folder.items())


def without_ros():
    """What pip installs beyond what catkin needs."""
    extras = requirements()
    entry = "{} = " + PACKAGE + ".commands.console:main"
    # Not src/ and build/ themselves, which hold the sources and catkin's build.
    build = FOLDER / "build" / "wheel"
    build.mkdir(parents=True, exist_ok=True)
    return {
        "install_requires": extras.pop(""),
        "extras_require": extras,
        "entry_points": {"console_scripts": [entry.format(name) for name in COMMANDS]},
        "data_files": data_files(),
        "ext_modules": [Extension(PACKAGE + "." + name, []) for name in MODULES],
        "cmdclass": {"build_ext": CMakeBuild},
        "options": {
            "build": {"build_base": str(build)},
            "egg_info": {"egg_base": str(build.relative_to(FOLDER))},
        },
    }


manifest = ElementTree.parse(str(FOLDER / "package.xml")).getroot()
maintainer = manifest.find("maintainer")
# catkin reads this file under another name than __main__, and sets this variable to install it.
by_catkin = __name__ != "__main__" or "CATKIN_BINARY_DIR" in os.environ
setup(
    name=PACKAGE,
    version=manifest.findtext("version"),
    description=" ".join(manifest.findtext("description").split()),
    author=manifest.findtext("author"),
    maintainer=maintainer.text,
    maintainer_email=maintainer.get("email"),
    license=manifest.findtext("license"),
    python_requires=">=3.8",
    packages=find_packages("src"),
    package_dir={"": "src"},
    package_data={PACKAGE + ".reproduction": ["*.j2"]},
    **({} if by_catkin else without_ros()),
)

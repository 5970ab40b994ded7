"""Where the package's files are found."""

from pathlib import Path

import pytest

from deformable_manipulation.system import package_files
from deformable_manipulation.system.package_files import package_share_directory


def test_share_directory_of_the_checkout():
    assert (package_share_directory() / "config" / "scenarios").is_dir()


def test_share_directory_of_an_install_space(tmp_path, monkeypatch):
    share = tmp_path / "share" / "deformable_manipulation"
    share.mkdir(parents=True)
    (share / "package.xml").write_text("<package><name>deformable_manipulation</name></package>")
    module = tmp_path / "lib/python3/dist-packages/deformable_manipulation/system/package_files.py"
    monkeypatch.setattr(package_files, "__file__", str(module))
    assert package_share_directory() == share.resolve()


def test_share_directory_passes_over_other_packages(tmp_path, monkeypatch):
    (tmp_path / "package.xml").write_text("<package><name>another</name></package>")
    monkeypatch.setattr(package_files, "__file__", str(tmp_path / "package_files.py"))
    monkeypatch.setattr(package_files, "ros_package", lambda name: Path("/by/ros") / name)
    assert package_share_directory() == Path("/by/ros/deformable_manipulation")
    monkeypatch.setattr(package_files, "ros_package", lambda name: None)
    with pytest.raises(FileNotFoundError, match="setup.bash"):
        package_share_directory()

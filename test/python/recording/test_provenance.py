from deformable_manipulation.recording.provenance import machine, package_version

MANIFEST = "<package><name>{}</name><version>{}</version></package>"


def write_manifest(folder, name, version):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(MANIFEST.format(name, version))


def test_version_in_a_source_tree(tmp_path):
    write_manifest(tmp_path, "deformable_manipulation", "1.2.3")
    assert package_version(tmp_path / "src" / "deformable_manipulation" / "a.py") == "1.2.3"


def test_version_in_an_install_space(tmp_path):
    write_manifest(tmp_path / "share" / "deformable_manipulation", "deformable_manipulation", "2.0")
    module = tmp_path / "lib" / "python3" / "dist-packages" / "deformable_manipulation" / "a.py"
    assert package_version(module) == "2.0"


def test_manifests_of_others_are_passed_over(tmp_path):
    write_manifest(tmp_path, "deformable_manipulation", "1.0.0")
    write_manifest(tmp_path / "inner", "another_package", "9.9.9")
    assert package_version(tmp_path / "inner" / "a.py") == "1.0.0"


def test_broken_or_missing_manifest_means_no_version(tmp_path):
    (tmp_path / "package.xml").write_text("<package><name>")
    assert package_version(tmp_path / "a.py") is None


def test_machine_is_named():
    assert set(machine()) == {"processor", "cores", "python"}

"""Which blocks are stale, in a small repository of its own."""

import subprocess

import pytest

from deformable_manipulation.commands import figures as command
from deformable_manipulation.figures import registry, state
from deformable_manipulation.figures.history import History, HistoryError
from deformable_manipulation.figures.present import present_origin
from deformable_manipulation.figures.registry import Subject
from deformable_manipulation.markdown.block import Provenance, read_blocks, write_block

PAGE = "page.md"


class Checkout:
    def __init__(self, folder):
        self.folder = folder
        self.git("init", "-q")
        (folder / "code").mkdir()
        (folder / PAGE).write_text("<!-- figures: one -->\n<!-- end -->\n")
        self.commit_change("code/core.py", "1")

    def git(self, *arguments):
        identity = ("-c", "user.name=a", "-c", "user.email=a@example.org")
        subprocess.run(["git", "-C", str(self.folder), *identity, *arguments], check=True)

    def commit_change(self, file, text):
        (self.folder / file).write_text(text)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", f"Change {file}")
        return History(self.folder).head()

    def write(self, commit, content="| 1 |"):
        origin = Provenance("measure", "a processor", commit, "2026-01-31")
        write_block(self.folder / PAGE, "one", content, origin)


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    def measure(say):
        say("measuring")
        return {"one": "| 2 |"}

    subjects = {"one": Subject({"one": PAGE}, "measure", ("code", ":(exclude)code/docs"), measure)}
    for module in (registry, state, command):
        monkeypatch.setattr(module, "SUBJECTS_BY_BLOCK", subjects)
    monkeypatch.setattr(state, "PAGES", (PAGE,))
    return Checkout(tmp_path)


def findings(checkout):
    return [(each.text, each.is_error) for each in state.examine(checkout.folder)]


def test_a_block_is_stale_once_its_code_has_changed(checkout):
    checkout.write(History(checkout.folder).head())
    assert findings(checkout) == []
    checkout.commit_change("other.py", "1")
    assert findings(checkout) == []
    checkout.commit_change("code/core.py", "2")
    ((text, is_error),) = findings(checkout)
    assert "Change code/core.py" in text and not is_error


def test_errors(checkout):
    assert findings(checkout) == [("was never measured", True)]
    checkout.write("0123456789ab")
    assert findings(checkout) == [("commit 0123456789ab is not in the history", False)]
    page = checkout.folder / PAGE
    page.write_text(page.read_text().replace("| 1 |", "| 3 |"))
    assert findings(checkout) == [("was edited by hand", True)]


def test_an_exported_tree_has_no_stale_blocks(checkout, tmp_path_factory):
    checkout.write("0123456789ab")
    exported = tmp_path_factory.mktemp("exported")
    (exported / PAGE).write_text((checkout.folder / PAGE).read_text())
    assert state.examine(exported) == []
    assert History(exported).head() == "unknown"


def test_numbers_of_uncommitted_code_are_refused(checkout):
    (checkout.folder / "code/core.py").write_text("3")
    with pytest.raises(HistoryError, match="code/core.py"):
        present_origin(checkout.folder, "measure", ("code",))


def test_the_command_checks_measures_and_accepts(checkout, capsys):
    where = ["--checkout", str(checkout.folder)]
    assert command.main(["--check", *where]) == 1
    assert "error: page.md: one: was never measured" in capsys.readouterr().out
    assert command.main(["one", *where]) == 0
    block = read_blocks(checkout.folder / PAGE)[0]
    assert block.content == "| 2 |"
    assert block.provenance.commit == History(checkout.folder).head()
    assert command.main(["--check", *where]) == 0

    page = checkout.folder / PAGE
    page.write_text(page.read_text().replace("| 2 |", "| 4 |"))
    assert command.main(["--check", *where]) == 1
    assert command.main(["one", "--accept", "HEAD", "--machine", "another one", *where]) == 0
    assert command.main(["--check", *where]) == 0
    assert read_blocks(page)[0].provenance.machine == "another one"
    assert command.main(["one", "--accept", "nothing", *where]) == 1
    assert "git log" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [[], ["two"], ["one", "--check", "--accept", "HEAD"]])
def test_wrong_usage(checkout, arguments):
    with pytest.raises(SystemExit) as error:
        command.main(arguments)
    assert error.value.code == 2

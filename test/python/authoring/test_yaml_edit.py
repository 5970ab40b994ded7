"""Values replaced in YAML text."""

import yaml
from hypothesis import given
from hypothesis import strategies as st

from deformable_manipulation.authoring.yaml_edit import replace_scalars, scalars

TEXT = """# first
name: old   # the name
list:
  - {file: a.csv, n: 1}
  - file: "b c.csv"
"""


def test_comments_and_order_stay():
    text = replace_scalars(TEXT, {("name",): "new", ("list", "1", "file"): "d e.csv"})
    expected = TEXT.replace("old", "new").replace("b c.csv", "d e.csv")
    assert text == expected


def test_paths_that_are_not_there_are_passed_over():
    assert replace_scalars(TEXT, {("nam",): "new", ("list", "2"): "x"}) == TEXT
    assert replace_scalars("# nothing\n", {("name",): "new"}) == "# nothing\n"


def test_all_values_are_found():
    assert scalars(TEXT) == {
        ("name",): "old",
        ("list", "0", "file"): "a.csv",
        ("list", "0", "n"): "1",
        ("list", "1", "file"): "b c.csv",
    }


@given(st.text(st.characters(blacklist_categories=["Cs", "Cc"]), max_size=20))
def test_any_text_stays_what_it_is(value):
    changed = yaml.safe_load(replace_scalars(TEXT, {("list", "0", "file"): value}))
    assert changed["list"] == [{"file": value, "n": 1}, {"file": "b c.csv"}]

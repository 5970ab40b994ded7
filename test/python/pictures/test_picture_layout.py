"""Several pictures in one."""

import numpy as np

from deformable_manipulation.pictures.picture_layout import labelled, overlaid, side_by_side

SHAPE = (60, 100, 3)


def plain(shade=250):
    return np.full(SHAPE, shade, dtype=np.uint8)


def with_block(rows, columns, shade=0):
    picture = plain()
    picture[rows, columns] = shade
    return picture


def test_earlier_pictures_are_paler_and_below():
    early = with_block(slice(0, 20), slice(0, 20))
    middle = with_block(slice(20, 40), slice(0, 20))
    late = with_block(slice(10, 30), slice(10, 20), 100)
    labels = with_block(slice(0, 10), slice(0, 20), 10)
    result = overlaid(plain(), plain(), [early, middle, late], labels)
    places = ((5, 5), (15, 5), (35, 5), (15, 15), (50, 50))
    label, first, second, last, nothing = (int(result[row, column, 0]) for row, column in places)
    assert nothing == 250 and last == 100 and label == 10
    assert 0 < second < first < 250


def test_what_they_have_in_common_comes_from_the_base():
    base = with_block(slice(50, 60), slice(0, 100), 40)  # trails
    picture = with_block(slice(0, 5), slice(0, 5))
    result = overlaid(base, plain(), [picture], plain())
    assert (result[50:] == 40).all() and (result[:5, :5] == 0).all()
    assert (result[10:50] == 250).all()


def test_side_by_side_they_keep_their_size():
    row = side_by_side([plain(10), plain(20), plain(30)])
    assert row.shape[0] == SHAPE[0] and row.shape[1] > 3 * SHAPE[1]
    assert (row[:, : SHAPE[1]] == 10).all() and (row[:, -SHAPE[1] :] == 30).all()


def test_a_label_changes_its_corner_alone():
    picture = np.full((200, 400, 3), 120, dtype=np.uint8)
    result = labelled(picture, "60 s", 30)
    assert (picture == 120).all()
    changed = (result != picture).any(axis=2)
    assert changed[:60, :140].any() and not changed[100:].any() and not changed[:, 200:].any()
    assert result.min() < 60 and result.max() == 255

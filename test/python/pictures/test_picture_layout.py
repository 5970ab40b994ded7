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


RED, BLUE = (255, 0, 0), (0, 0, 255)


def test_each_picture_has_its_color_and_labels_are_above():
    early = with_block(slice(0, 20), slice(0, 20))
    late = with_block(slice(20, 30), slice(0, 20), 100)
    labels = with_block(slice(0, 10), slice(0, 20), 10)
    result = overlaid(plain(), plain(), [early, late], [RED, BLUE], labels).astype(int)
    label, first, second, nothing = (result[row, 15] for row in (5, 15, 25, 50))
    assert (nothing == 250).all() and (label == 10).all()
    assert first[0] > 150 and first[1] == first[2] == 0
    assert second[2] > 150 and second[0] == second[1] == 0


def test_pictures_of_the_same_place_are_both_seen():
    block = with_block(slice(0, 60), slice(0, 60))
    result = overlaid(plain(), plain(), [block, block], [RED, BLUE], plain()).astype(int)[:, :60]
    red, blue = result[..., 0] > 150, result[..., 2] > 150
    assert (red ^ blue).all() and 0.3 < red.mean() < 0.7


def test_what_is_faint_stays_faint():
    faint = with_block(slice(0, 20), slice(0, 20), 202)  # half as far from 250 as what is opaque
    result = overlaid(plain(), plain(), [faint], [RED], plain()).astype(int)
    assert 100 < result[5, 5, 1] < 150


def test_the_trails_are_gray():
    base = plain()
    base[50:] = (240, 150, 20)
    picture = with_block(slice(0, 5), slice(0, 5))
    result = overlaid(base, plain(), [picture], [RED], plain())
    assert (result[50:] == result[50, 0, 0]).all() and 20 < result[50, 0, 0] < 240
    assert (result[10:50] == 250).all()


def test_side_by_side_they_keep_their_size():
    row = side_by_side([plain(10), plain(20), plain(30)])
    assert row.shape[0] == SHAPE[0] and row.shape[1] > 3 * SHAPE[1]
    assert (row[:, : SHAPE[1]] == 10).all() and (row[:, -SHAPE[1] :] == 30).all()


INKED = [("60 s", 30, (0, 0, 0))]


def test_a_label_changes_its_corner_alone():
    picture = np.full((200, 400, 3), 120, dtype=np.uint8)
    result = labelled(picture, INKED)
    assert (picture == 120).all()
    changed = (result != picture).any(axis=2)
    assert changed[:60, :140].any() and not changed[100:].any() and not changed[:, 200:].any()
    assert result.min() < 60 and result.max() == 255


def test_lines_are_below_each_other_in_their_colors():
    picture = np.full((200, 400, 3), 120, dtype=np.uint8)
    result = labelled(picture, [*INKED, ("52 mm", 20, (200, 0, 0))]).astype(int)
    black, red = result.max(axis=2) < 40, result[..., 0] - result[..., 1] > 150
    assert np.flatnonzero(black.any(axis=1)).max() < np.flatnonzero(red.any(axis=1)).min()


def test_a_label_goes_where_it_hides_nothing():
    busy = np.full((200, 400, 3), 250, dtype=np.uint8)
    busy[:100, ::7] = 0  # the upper corners
    busy[100:, :200:7] = 0  # the lower left one
    changed = (labelled(busy, INKED, clear_of=[busy]) != busy).any(axis=2)
    assert changed[100:, 200:].any() and not changed[:100].any() and not changed[:, :200].any()

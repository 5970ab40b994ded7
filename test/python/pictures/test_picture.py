import itertools

import numpy as np
import pytest

from deformable_manipulation.pictures.picture import (
    PictureAtRest,
    same_looks_after,
    save_png,
    shows_scene,
)

BACKGROUND = (250, 250, 250)


def blank():
    return np.full((120, 200, 3), BACKGROUND, dtype=np.uint8)


def grid():
    picture = blank()
    for shade, step in ((215, 10), (225, 15), (235, 22)):
        picture[::step] = picture[:, ::step] = shade
    return picture


def scene():
    picture = grid()
    picture[80:] = (130, 125, 115)  # ground
    picture[40:44, 20:150] = (140, 64, 13)  # rope
    picture[30:45, 20:30] = (240, 150, 25)  # agent
    return picture


def test_a_scene_is_told_from_nothing():
    assert shows_scene(scene())
    assert not shows_scene(blank())
    assert not shows_scene(grid())


def test_the_ground_may_fill_most_of_the_picture():
    picture = scene()
    picture[46:] = (130, 125, 115)
    assert shows_scene(picture)


def test_thin_things_seen_from_afar_are_a_scene():
    picture = np.full((800, 1280, 3), BACKGROUND, dtype=np.uint8)
    picture[300:301, 300:700] = (140, 64, 13)  # rope
    picture[395:405, 295:305] = (240, 150, 25)  # agent
    picture[300:555, 580:660] = (150, 145, 136)  # box
    picture[350:390, 600:640] = (195, 190, 180)  # its top
    assert shows_scene(picture)


def test_a_black_screen_and_one_thing_alone_are_no_scene():
    picture = np.zeros((120, 200, 3), dtype=np.uint8)
    assert not shows_scene(picture)
    picture[50:60, 50:60] = 255
    assert not shows_scene(picture)


def test_specks_are_no_scene():
    picture = blank()
    for i in range(8):
        picture[10 * i, 10 * i] = (32 * i, 100, 10)
    assert not shows_scene(picture)


def looks(pictures):
    """PictureAtRest that sees one picture after the other, and the last forever."""
    pictures = iter(pictures)
    last = None

    def look():
        nonlocal last
        last = next(pictures, last)
        return last

    return PictureAtRest(look, clock=itertools.count(0.0, 1.0).__next__)


def test_a_picture_is_taken_once_it_is_at_rest():
    moving = [np.roll(scene(), i, axis=1) for i in range(20)]
    look = looks([blank()] * 20 + moving + [scene()])
    count = next(i for i in range(1, 100) if look.again())
    assert count > len(moving) + 20
    np.testing.assert_array_equal(look.picture, scene())


def test_a_program_that_started_slowly_is_watched_for_longer():
    assert same_looks_after(0.5) == same_looks_after(2.0) == 5
    assert same_looks_after(20.0) == 40


@pytest.mark.parametrize(
    "pictures, complaint",
    [
        ([blank()], "nothing was rendered"),
        ([grid()], "nothing was rendered"),
        ([np.roll(scene(), i, axis=1) for i in range(100)], "did not stop changing"),
    ],
)
def test_what_is_amiss_is_told(pictures, complaint):
    look = looks(pictures)
    assert not any(look.again() for _ in range(50))
    assert complaint in look.complaint()


def test_the_screen_is_not_read_all_the_time():
    times = iter([0.0, 0.01, 0.02])
    count = itertools.count(1)
    look = PictureAtRest(lambda: scene() + 0 * next(count), clock=lambda: next(times))
    for _ in range(3):
        look.again()
    assert next(count) == 2


def test_a_saved_picture_reads_the_same(tmp_path):
    image = pytest.importorskip("matplotlib.image")
    path = tmp_path / "new" / "picture.png"
    save_png(scene(), path, "a scene")
    read = np.rint(255 * image.imread(str(path))[:, :, :3]).astype(np.uint8)
    np.testing.assert_array_equal(read, scene())
    assert b"a scene" in path.read_bytes()

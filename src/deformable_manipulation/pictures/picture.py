"""Pictures of a screen: whether they show something, when they have come to rest, saving them."""

import math
import time

import numpy as np

_CLEARLY_DIFFERENT = 40  # of 255, in a channel; a faint grid is less
_SHADES = 32  # of 256: colors are distinguished in steps of this size
_LEAST_SHARE = 1e-4  # of the picture, for a color; a thin rope from afar is hardly more
_LEAST_COLORS = 3  # beside the background
_PERIOD = 0.1  # s between looks
_SAME_LOOKS = 5  # in a row, for a picture at rest
_START_SHARE = 0.2  # of the time that a program took to start: how long its picture is to rest


def shows_scene(pixels):
    """Whether a picture (height, width, 3) holds more than a background and a faint grid.

    Several colors that clearly differ from the most frequent one, each in enough pixels.
    """
    colors = np.asarray(pixels, dtype=np.uint8).reshape(-1, 3)
    codes = (colors // _SHADES).astype(np.int64) @ [64, 8, 1]
    background = np.median(colors[codes == np.bincount(codes).argmax()], axis=0)
    different = np.abs(colors - background).max(axis=1) > _CLEARLY_DIFFERENT
    counts = np.bincount(codes[different], minlength=1)
    return np.count_nonzero(counts >= _LEAST_SHARE * len(colors)) >= _LEAST_COLORS


def same_looks_after(start):
    """Looks in a row that tell a picture at rest, of a program that took so long [s] to start.

    On a busy machine it draws as slowly as it has started: a picture that stays the same for half a
    second may lack what has not been drawn yet.
    """
    return max(_SAME_LOOKS, math.ceil(_START_SHARE * start / _PERIOD))


class PictureAtRest:
    """Looks at a screen until the picture shows something and no longer changes.

    Args:
        look: gives the picture (height, width, 3) as it is now.
        clock: s, never decreasing.
        shows: whether a picture shows what it is to show.
        period: between looks [s].
        same_looks: in a row, for a picture at rest.
    """

    def __init__(
        self,
        look,
        clock=time.monotonic,
        shows=shows_scene,
        period=_PERIOD,
        same_looks=_SAME_LOOKS,
    ):
        self._look = look
        self._clock = clock
        self._shows = shows
        self._period = period
        self._same_looks = same_looks
        self._last_look = -np.inf
        self._same = 0
        self.picture = None

    def again(self):
        """Look again if it is time to; whether the picture shows something and is at rest."""
        now = self._clock()
        if now - self._last_look < self._period:
            return False
        self._last_look = now
        picture = self._look()
        same = self.picture is not None and np.array_equal(picture, self.picture)
        self._same = self._same + 1 if same else 1
        self.picture = picture
        return self._same >= self._same_looks and self._shows(picture)

    def complaint(self):
        """What is amiss with the last picture."""
        if self.picture is None or not self._shows(self.picture):
            return "nothing was rendered: the 3D view is blank"
        return "the picture did not stop changing"


def save_png(picture, path, description):
    """Write a picture (height, width, 3) with a description in its metadata; makes the folder.

    Raises:
        OSError: it cannot be written.
    """
    # Imported late: matplotlib loads slowly, and a mistake in the arguments is reported at once.
    from matplotlib.image import imsave

    path.parent.mkdir(parents=True, exist_ok=True)
    imsave(str(path), picture, metadata={"Description": description})

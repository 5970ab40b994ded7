"""Several pictures in one: overlaid or side by side, with their times."""

import numpy as np

_DIFFERENT = 12  # of 255, in a channel, from the picture without what moves
_ALIKE = 0.5  # of the pixels of pictures of the same view
_PALEST = 0.45  # opacity of the earliest of overlaid pictures
_GAP = 8  # pixels between pictures side by side
_WHITE = 255
_INK = (26, 26, 26)
_MARGIN = 0.4  # of the letters' height, around a label


def is_alike(picture, other):
    """Whether most of two pictures is the same: the background, and what stands still."""
    difference = np.abs(picture.astype(int) - other).max(axis=2)
    return np.mean(difference <= _DIFFERENT) > _ALIKE


def overlaid(base, empty, pictures, top):
    """Pictures (height, width, 3) over each other, the earlier ones paler.

    Args:
        base: what they are laid over.
        empty: the pictures without what moves.
        pictures: in their order; what they differ in from the empty one is laid over the base.
        top: a picture that is laid over them all in the same way.
    """
    result = base.astype(float)
    opacities = np.linspace(_PALEST, 1.0, len(pictures)) if len(pictures) > 1 else [1.0]
    for picture, opacity in zip([*pictures, top], [*opacities, 1.0]):
        difference = np.abs(picture.astype(int) - empty).max(axis=2)
        moves = difference > _DIFFERENT
        result[moves] += opacity * (picture[moves] - result[moves])
    return np.rint(result).astype(np.uint8)


def side_by_side(pictures):
    """Pictures (height, width, 3) of the same height in a row."""
    gap = np.full((len(pictures[0]), _GAP, 3), _WHITE, dtype=np.uint8)
    row = [part for picture in pictures for part in (gap, picture)]
    return np.concatenate(row[1:], axis=1)


def labelled(picture, text, height):
    """A copy of a picture with a text of some height [pixels] in its upper left corner."""
    # Imported late: they take longer to load than a mistake in the arguments to be told.
    from matplotlib.font_manager import findfont
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    font = ImageFont.truetype(findfont("DejaVu Sans"), height)
    margin = round(_MARGIN * height)
    box = draw.textbbox((2 * margin, 2 * margin), text, font=font)
    draw.rectangle(
        (margin, margin, box[2] + margin, box[3] + margin), fill=(_WHITE, _WHITE, _WHITE)
    )
    draw.text((2 * margin, 2 * margin), text, fill=_INK, font=font)
    return np.asarray(image)

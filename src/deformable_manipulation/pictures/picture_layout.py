"""Several pictures in one: overlaid or side by side, with their times."""

import numpy as np

_DIFFERENT = 12  # of 255, in a channel, from the picture without what moves
_ALIKE = 0.5  # of the pixels of pictures of the same view
_STRIPE = 14  # pixels along an edge
_OPAQUE = 96.0  # of 255, from the picture without what moves; less is taken as translucent
_DARKEST = 0.7  # brightness of what is black in a picture that is drawn in one color
_CLEARLY = 60  # of 255, in a channel: differs more than a faint grid
_GAP = 8  # pixels between pictures side by side
_WHITE = 255
INK = (26, 26, 26)
_MARGIN, _LINE_SPACING = 0.4, 1.3  # of the letters' height, around a label and of its lines


def is_alike(picture, other):
    """Whether most of two pictures is the same: the background, and what stands still."""
    difference = np.abs(picture.astype(int) - other).max(axis=2)
    return np.mean(difference <= _DIFFERENT) > _ALIKE


def overlaid(base, empty, pictures, colors, top):
    """Pictures (height, width, 3) over each other, each in one color.

    Where several of them show something, they take turns in stripes, so that none hides another.

    Args:
        base: what they are laid over, in shades of gray where it differs from the empty picture.
        empty: the pictures without what moves.
        pictures: in their order; what they differ in from the empty one is laid over the base.
        colors: of the pictures, (red, green, blue) up to 255.
        top: a picture that is laid over them all as it is.
    """
    result = base.astype(float)
    traces = _differs(base, empty)
    result[traces] = _brightness(base[traces])[:, None]
    covered = np.zeros(base.shape[:2], dtype=int)
    stripes = np.add.outer(*(np.arange(length) for length in base.shape[:2])) // _STRIPE
    for picture, color in zip(pictures, colors):
        moves = _differs(picture, empty)
        covered[moves] += 1
        moves &= stripes % np.maximum(covered, 1) == np.maximum(covered, 1) - 1
        difference = np.abs(picture[moves].astype(int) - empty[moves]).max(axis=1)
        opacity = np.minimum(difference / _OPAQUE, 1.0)[:, None]
        light = _DARKEST + (1.0 - _DARKEST) * _brightness(picture[moves])[:, None] / _WHITE
        result[moves] += opacity * (light * np.array(color) - result[moves])
    result[_differs(top, empty)] = top[_differs(top, empty)]
    return np.rint(result).astype(np.uint8)


def _differs(picture, empty):
    return np.abs(picture.astype(int) - empty).max(axis=2) > _DIFFERENT


def _brightness(colors):
    return colors @ np.array([0.299, 0.587, 0.114])


def side_by_side(pictures):
    """Pictures (height, width, 3) of the same height in a row."""
    gap = np.full((len(pictures[0]), _GAP, 3), _WHITE, dtype=np.uint8)
    row = [part for picture in pictures for part in (gap, picture)]
    return np.concatenate(row[1:], axis=1)


def labelled(picture, lines, clear_of=()):
    """A copy of a picture with some lines of text in a corner.

    Args:
        lines: (text, height [pixels], color) of each.
        clear_of: pictures (height, width, 3); the corner is the one where the least of them would
            be hidden. Default: the upper left one.
    """
    # Imported late: they load slowly, and a mistake in the arguments is reported at once.
    from matplotlib.font_manager import findfont
    from PIL import Image, ImageDraw, ImageFont

    path = findfont("DejaVu Sans")
    fonts = [ImageFont.truetype(path, height) for _, height, _ in lines]
    margin = round(_MARGIN * max(height for _, height, _ in lines))
    widths = [font.getbbox(text)[2] for font, (text, _, _) in zip(fonts, lines)]
    heights = [round(_LINE_SPACING * height) for _, height, _ in lines]
    box = (max(widths) + 2 * margin, sum(heights) + 2 * margin)  # width, height
    image = Image.fromarray(picture)
    left, upper = _calm_corner(image.size, box, margin, clear_of)
    draw = ImageDraw.Draw(image)
    draw.rectangle((left, upper, left + box[0], upper + box[1]), fill=(_WHITE, _WHITE, _WHITE))
    upper += margin
    for font, height, (text, _, color) in zip(fonts, heights, lines):
        draw.text((left + margin, upper), text, fill=tuple(color), font=font)
        upper += height
    return np.asarray(image)


def _calm_corner(whole, size, margin, pictures):
    """Left and upper edge of a box in the corner where it hides the least of some pictures."""
    width, height = whole
    corners = [
        (left, upper)
        for upper in (margin, max(height - margin - size[1], 0))
        for left in (margin, max(width - margin - size[0], 0))
    ]

    def hidden(corner):
        left, upper = corner
        box = slice(upper, upper + size[1]), slice(left, left + size[0])
        parts = [picture[box].reshape(-1, 3).astype(int) for picture in pictures]
        background = [np.median(part, axis=0) for part in parts]
        different = [np.abs(part - color) > _CLEARLY for part, color in zip(parts, background)]
        return sum(np.count_nonzero(each.any(axis=1)) for each in different)

    return min(corners, key=hidden)

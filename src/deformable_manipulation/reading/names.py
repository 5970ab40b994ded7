"""Readers of names."""

import re

from deformable_manipulation.reading.readers import Text

# Names become parts of file names, which file systems limit to 255 bytes.
ONE_LINE = Text(
    re.compile(r"[^\s/][^\n\r/]{0,99}"),
    "a text on one line, without '/', of at most 100 characters",
)
FRAME = Text(re.compile(r"[A-Za-z][A-Za-z0-9_/]*"), "a tf frame: letters, digits, _ and / inside")
TOPIC = Text(
    re.compile(r"/?[A-Za-z][A-Za-z0-9_]*(/[A-Za-z][A-Za-z0-9_]*)*"),
    "a ROS topic: names of letters, digits and _ between /",
)

"""Readers of names."""

import re

from deformable_manipulation.scenario.readers import Text

ONE_LINE = Text(re.compile(r"[^\s/][^\n\r/]*"), "a text on one line, without '/'")
FRAME = Text(re.compile(r"[A-Za-z][A-Za-z0-9_/]*"), "a tf frame: letters, digits, _ and / inside")

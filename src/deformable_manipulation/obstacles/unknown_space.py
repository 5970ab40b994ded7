"""What a map does not know."""

from deformable_manipulation.reading.readers import Choice

FREE, OCCUPIED = "free", "occupied"
UNKNOWN = Choice(FREE, OCCUPIED)

"""Other libraries: an optional environment of their own, and the same rods in each of them."""

"""How leader and obstacles move: along their paths, as measured, or by hand."""

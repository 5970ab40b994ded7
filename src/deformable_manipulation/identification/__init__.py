"""Parameters of a real object, from recordings of its motion."""

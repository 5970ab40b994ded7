"""What is carried: all that Python knows of each kind of object, in a module of its own."""

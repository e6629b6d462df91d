"""A clock that a whole arena shares and that can run faster than real time."""

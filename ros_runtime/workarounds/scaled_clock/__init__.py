"""A clock that all processes of an arena share, and that can run faster than real time."""

"""Makes the folder of a new exercise, which passes its own audit and waits to be changed."""

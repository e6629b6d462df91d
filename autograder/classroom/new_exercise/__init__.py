"""Creates the folder of a new exercise, a working example that passes its own audit."""

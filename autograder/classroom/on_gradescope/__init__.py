"""Inside Gradescope's container: what was handed in is graded there, with the visible checks."""

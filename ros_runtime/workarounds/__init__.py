"""Code that works around other people's: README.md says for each piece why, and how to remove it."""

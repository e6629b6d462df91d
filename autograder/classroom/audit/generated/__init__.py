"""Mistakes with a meaning, made by a program in correct submissions: what the checks do not notice is a gap in them."""

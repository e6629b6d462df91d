"""The questions of the chapters, kept out of the notebooks so that the answers are not read along the way."""

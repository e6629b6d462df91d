"""The book: chapters with their outputs, exercises and docs as one static site for readers without a robot."""

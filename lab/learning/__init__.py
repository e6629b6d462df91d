"""Quizzes, predictions, gaps and designs, and the student's progress in them."""

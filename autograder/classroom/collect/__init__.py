"""Converts a platform's download to submitted/<student>/<exercise>/, which `course grade` reads."""

"""Renders verdicts as tables, sequence diagrams and pages. It only reads grades and transcripts."""

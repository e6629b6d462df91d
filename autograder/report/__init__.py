"""Renders verdicts for people: tables, sequence diagrams, pages. Reads records, decides nothing."""

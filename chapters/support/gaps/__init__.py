"""The checks of the gaps, one module for each chapter."""

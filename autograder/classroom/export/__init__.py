"""Exports the grades of a batch to other platforms: one module per format; "not graded" means the same in all."""

"""The grades of a batch as other platforms take them: one writer a file, and one meaning of "not graded" in all."""

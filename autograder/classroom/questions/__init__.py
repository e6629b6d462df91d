"""Questions to each student about their own program and its run, with keys for the examiner; no language model."""

"""A whole class at once: find the submissions, grade them in parallel, remember what is done, write it down."""

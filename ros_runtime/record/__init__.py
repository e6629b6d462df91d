"""A record of typed events: written where they happen, kept in a log to wait on, and read back elsewhere."""

"""What happened, as typed events: written where it happens, kept in a log that people wait on, read back elsewhere."""

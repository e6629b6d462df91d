"""Programs that the checks of gaps run in separate processes, to test a student's file."""

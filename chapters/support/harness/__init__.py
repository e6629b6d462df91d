"""Programs that the checks of gaps run as processes of their own, to test a student's file."""

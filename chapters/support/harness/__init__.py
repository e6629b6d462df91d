"""Programs that checks of gaps run beside a student's file, each in a process of its own."""

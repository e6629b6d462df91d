"""The console script `course`: one command a file under course_cli/commands/."""

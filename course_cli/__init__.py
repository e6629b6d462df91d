"""The console script `course`, with one file per command in course_cli/commands/."""

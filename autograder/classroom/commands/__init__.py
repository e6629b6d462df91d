"""The commands for instructors."""

"""The commands for developers of the toolkit, which only a clone has."""

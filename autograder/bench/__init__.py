"""What the toolkit costs and whether it stays fair: measured, printed, never a test."""

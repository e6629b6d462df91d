"""What any server and any client must do."""

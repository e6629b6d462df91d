"""The `ros2` commands that the course uses, with ros2cli's words and output, for machines without ros2cli."""

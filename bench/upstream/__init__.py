"""rclpy's own tests, run with what the course changes in rclpy and in time: `course bench --upstream`."""

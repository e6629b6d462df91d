"""What lab and arena share: the environment of a ROS process, the repairs of rclpy, the scaled clock."""

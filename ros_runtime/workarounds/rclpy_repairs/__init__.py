"""Repairs of faults in rclpy that would cost a correct node points; every process of the environment has them."""

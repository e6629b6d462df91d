"""Repairs of rclpy's faults that would cost a correct node points; every process of the environment has them."""

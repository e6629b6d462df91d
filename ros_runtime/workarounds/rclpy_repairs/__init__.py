"""Repairs of faults in rclpy that would cost a sound node its marks; every process of the environment has them."""

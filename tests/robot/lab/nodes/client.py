"""Prints its arguments and a line on stderr, and ends with the given status; without a status it runs on."""

import sys
import time

from rclpy.utilities import remove_ros_args

arguments = remove_ros_args()[1:]
print("arguments:", *arguments)
print("with ROS:", "__ns:=/robot" in sys.argv)
print("a complaint", file=sys.stderr)
if not arguments:
    time.sleep(3600)
sys.exit(int(arguments[0]))

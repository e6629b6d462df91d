"""The humanoid: MuJoCo physics, walking, battery, and its ROS interface."""

from ros_runtime.workarounds import gl_backend as gl_backend  # before mujoco is imported

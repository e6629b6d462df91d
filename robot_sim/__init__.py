"""The humanoid: MuJoCo physics, walking, battery, and its ROS face."""

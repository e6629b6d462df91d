"""What the robot is made of: bodies, joints, motors, the scenes it stands in."""

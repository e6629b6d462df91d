"""The robot's bodies, joints and motors (humanoid.xml), and the scenes it stands in."""

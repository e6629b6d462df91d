"""Balance and gait: where the feet go, and the torques that keep the trunk upright."""

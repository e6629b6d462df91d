"""Generated programs in arenas: they use ROS legally, and do not do their exercise."""

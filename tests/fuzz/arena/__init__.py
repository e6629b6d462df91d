"""Made-up programs in arenas: legal ROS, and nothing that helps anybody."""

"""The chapters' questions. They are not in the notebooks, so that students do not see the answers while they read."""

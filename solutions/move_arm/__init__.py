"""An action server that moves an arm along a trajectory."""

"""The inertial sensor, and the state estimated from all sensors."""

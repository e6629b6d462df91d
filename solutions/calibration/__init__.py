"""The IMU is calibrated by a service, which waits, asks another service, and keeps its heartbeat all the while."""

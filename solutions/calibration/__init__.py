"""Chapter 5: a service calibrates the IMU; meanwhile it waits, calls another service and publishes its heartbeat."""

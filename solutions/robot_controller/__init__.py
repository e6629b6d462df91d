"""Chapter 3: a client that enables the motors and requests the status, whatever the servers do."""

"""Chapter 3: a client that enables the motors and asks for the status, whatever the servers do."""

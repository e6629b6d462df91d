"""What every ROS process of the course shares.

Processes and the network between them: `environment`, `ros_domain`, `notebook_domains`, `reachability`.
Messages: `messages` (their fields and types), `message_constants`, `angles`, `interface_build/`, `drawing/`.
What is said and heard: `record/`, `recorded_client/`.
What students write and have done: `design`, `self_checks`. Everywhere: `project` (folders), `course_error`.
What works around other software: `workarounds/`.
"""

"""What every ROS process of the course shares.

Processes and the network between them: `environment`, `ros_domain`, `notebook_domains`, `reachability`.
Messages: `messages` (their fields and types), `message_constants`, `angles`, `interface_build/`, `drawing/`.
Recorded requests and messages: `record/`, `recorded_client/`.
What students write, and their progress: `design`, `self_checks`. Used everywhere: `project` (folders), `course_error`.
Workarounds for other software: `workarounds/`.
"""

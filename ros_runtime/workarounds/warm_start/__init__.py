"""An interpreter that has loaded rclpy and waits; a fork of it becomes a program, as if that had just been started."""

WAITING = "COURSE_WAITING_INTERPRETER"  # in the environment of an arena's leading program: "SOCKET PROCESS"

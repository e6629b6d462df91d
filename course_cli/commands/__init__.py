"""One module for each command of `course`; `course_cli.app` lists the commands."""

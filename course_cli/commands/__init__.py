"""One module a command of `course`; `course_cli.app` lists them."""

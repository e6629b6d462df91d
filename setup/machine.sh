# Sourced by ./course: on a machine that cannot run the course, says why, and what to do instead.

# Fail, and say what to do, unless this is Linux on a processor for which the packages exist.
# Bash's variables have both, so no program is started.
refuse_machine() {
    if [[ $OSTYPE != linux* ]]; then
        echo "course: this is $OSTYPE, and the course runs on Linux." >&2
        echo "Next: run it in a container or, on Windows, in WSL2: docs/any_machine.md has the commands." >&2
        echo "Without Linux you can read the book, a site that ./course book makes on another machine." >&2
        return 1
    fi
    if [ "$ros" = wheels ] && [ "$HOSTTYPE" != x86_64 ]; then
        echo "course: this processor is $HOSTTYPE, and rclpy on PyPI is made for x86_64 only." >&2
        echo "Next: source ROS 2 Jazzy from apt (Ubuntu 24.04), and type the same command again." >&2
        echo "Or run the course in a container for linux/amd64: docs/any_machine.md has the commands." >&2
        return 1
    fi
}

# Sourced by ./course: on a machine that cannot run the course at all, says what is missing and what works there instead.

# Fail, and say what to do, unless this is Linux on a processor that the packages are made for.
# Bash knows both without starting a program.
refuse_machine() {
    if [[ $OSTYPE != linux* ]]; then
        echo "course: this is $OSTYPE, and the course runs on Linux." >&2
        echo "Next: run it in a container or, on Windows, in WSL2: docs/any_machine.md has the lines to type." >&2
        echo "What works here without: the site for readers, which ./course book makes on another machine." >&2
        return 1
    fi
    if [ "$ros" = wheels ] && [ "$HOSTTYPE" != x86_64 ]; then
        echo "course: this processor is $HOSTTYPE, and rclpy on PyPI is made for x86_64 only." >&2
        echo "Next: source ROS 2 Jazzy from apt (Ubuntu 24.04), and type the same command again: everything works then." >&2
        echo "Or run it in a container for linux/amd64: docs/any_machine.md has the lines to type." >&2
        return 1
    fi
}

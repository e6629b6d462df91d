# Sourced by ./course where ROS 2 from apt is used: two releases of its rclpy cannot be graded with.
#
# In 7.1.8 and 7.1.9 a goal's succeed(), canceled() and abort() send an empty result before the execute callback returns
# its own, so a correct server loses its result now and then (ros2/rclpy#1598, #1617). 7.1.10 has the remedy (#1604).

# Fail, and say what to do, if the package.xml of rclpy is that of such a release.
refuse_faulty_rclpy() {
    [ -r "$1" ] && [[ $(<"$1") =~ \<version\>[[:space:]]*(7\.1\.[89])[[:space:]]*\</version\> ]] || return 0
    echo "course: ROS 2 from apt has rclpy ${BASH_REMATCH[1]}, in which the result of a correct action server can arrive" \
        "empty (ros2/rclpy#1598, #1617); 7.1.10 and later, and 7.1.7 and earlier, do not have the fault." >&2
    echo "Next: sudo apt update && sudo apt upgrade ros-jazzy-rclpy" >&2
    echo "or run ./course in a terminal in which ROS is not sourced: it then uses its own rclpy." >&2
    return 1
}

# Sourced by ./course if ROS 2 from apt is used: refuses two releases of rclpy that lose the results of correct servers.
#
# In 7.1.8 and 7.1.9 a goal's succeed(), canceled() and abort() send an empty result before the execute callback returns
# the server's result, so the client sometimes receives the empty one (ros2/rclpy#1598, #1617). 7.1.10 fixes it (#1604).

# refuse_faulty_rclpy PACKAGE_XML: fail, and say what to do, if rclpy's package.xml has one of these versions.
refuse_faulty_rclpy() {
    [ -r "$1" ] && [[ $(<"$1") =~ \<version\>[[:space:]]*(7\.1\.[89])[[:space:]]*\</version\> ]] || return 0
    echo "course: ROS 2 from apt has rclpy ${BASH_REMATCH[1]}, in which the result of a correct action server can arrive" \
        "empty (ros2/rclpy#1598, #1617); 7.1.10 and later, and 7.1.7 and earlier, do not have the fault." >&2
    echo "Next: sudo apt update && sudo apt upgrade ros-jazzy-rclpy" >&2
    echo "or run ./course in a terminal in which ROS is not sourced: it then uses its own rclpy." >&2
    return 1
}

# Builds with the ROS wheels load this file through CMAKE_PROJECT_<package>_INCLUDE, which takes only one file.

include("${CMAKE_CURRENT_LIST_DIR}/drop_missing_includes.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/only_for_python.cmake")

# Loaded through CMAKE_PROJECT_<package>_INCLUDE, which takes one file, when the build uses the ROS wheels.

include("${CMAKE_CURRENT_LIST_DIR}/drop_missing_includes.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/only_for_python.cmake")

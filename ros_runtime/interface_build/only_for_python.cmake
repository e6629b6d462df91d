# rclpy needs no C++ code, and a build without it takes half the time. find_package registers the generators of a
# package and of its dependencies, so the C++ generators are removed from the list after each call.

macro(find_package)
  _find_package(${ARGV})
  list(FILTER AMENT_EXTENSIONS_rosidl_generate_idl_interfaces EXCLUDE REGEX "_cpp:")
endmacro()

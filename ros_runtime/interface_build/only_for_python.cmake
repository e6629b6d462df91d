# rclpy needs no code in C++: without it a build takes half the time. A package registers its generator when it is
# found, and those of the dependencies come with them.

macro(find_package)
  _find_package(${ARGV})
  list(FILTER AMENT_EXTENSIONS_rosidl_generate_idl_interfaces EXCLUDE REGEX "_cpp:")
endmacro()

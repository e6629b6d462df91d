# The imported targets of the ROS wheels name include directories of the machine on which the wheels were made
# (/opt/python/...). CMake refuses imported targets whose directories do not exist, so these are dropped.
# Only Python headers were there, and CMake finds them by Python3_EXECUTABLE anyway.

function(drop_missing_include_directories)
  get_property(targets DIRECTORY PROPERTY IMPORTED_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(directories ${target} INTERFACE_INCLUDE_DIRECTORIES)
    if(NOT directories)
      continue()
    endif()
    set(existing "")
    foreach(directory IN LISTS directories)
      if(NOT IS_ABSOLUTE "${directory}" OR EXISTS "${directory}")
        list(APPEND existing "${directory}")
      endif()
    endforeach()
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing}")
  endforeach()
endfunction()

# find_package creates the targets after project(), so this runs at the end of the folder's CMakeLists.txt.
cmake_language(DEFER CALL drop_missing_include_directories)

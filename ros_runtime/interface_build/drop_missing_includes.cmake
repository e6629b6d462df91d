# The imported targets of the ROS wheels name include directories of the machine that made them
# (/opt/python/...); CMake refuses imported targets whose directories do not exist.
# The Python headers come from Python3_EXECUTABLE anyway, so dropping them loses nothing.

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

# The targets appear with find_package, after project(): look at them when the folder's list file ends.
cmake_language(DEFER CALL drop_missing_include_directories)

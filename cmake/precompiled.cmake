# Headers that most sources include, compiled once: half of the build's time without them is spent
# reading Eigen, the standard library and gtest again for each source. Targets of one kind share
# one compilation; for that, programs and nodes have a library's position-independent code.
find_package(Eigen3 REQUIRED)
find_package(tl-expected REQUIRED)
find_package(yaml-cpp REQUIRED)
set(OTTER_NAV_PRECOMPILED
    <algorithm> <array> <cmath> <functional> <limits> <memory> <optional> <sstream> <string>
    <utility> <vector> <Eigen/Cholesky> <Eigen/Core> <tl/expected.hpp> <yaml-cpp/yaml.h>)

# For what knows ROS the list is short: GCC refuses a precompiled header of 300 MB.
set(OTTER_NAV_PRECOMPILED_ROS
    <algorithm> <cmath> <functional> <memory> <optional> <string> <utility> <vector>
    <nav_msgs/Odometry.h> <ros/node_handle.h>)

function(otter_nav_add_precompiled kind main headers)
  set(target otter_nav_precompiled_${kind})
  if(kind STREQUAL "test")
    add_executable(${target} ${main})
  else()
    add_library(${target} STATIC ${main})
  endif()
  target_include_directories(${target} SYSTEM PRIVATE ${EIGEN3_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE tl::expected yaml-cpp ${ARGN})
  if(kind STREQUAL "ros")
    target_include_directories(${target} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
    target_link_libraries(${target} PRIVATE ${catkin_LIBRARIES})
  endif()
  target_precompile_headers(${target} PRIVATE ${headers})
endfunction()

# otter_nav_precompiled(target kind): kind is library (programs too), ros or test.
function(otter_nav_precompiled target kind)
  if(NOT OTTER_NAV_PRECOMPILE)
    return()
  endif()
  if(NOT TARGET otter_nav_precompiled_${kind})
    set(main ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp)
    if(NOT EXISTS ${main})
      file(WRITE ${main} "int main() {\n  return 0;\n}\n")
    endif()
    set(headers ${OTTER_NAV_PRECOMPILED})
    set(libraries "")
    if(kind STREQUAL "test")
      list(APPEND headers <gtest/gtest.h>)
      set(libraries GTest::gtest)
    elseif(kind STREQUAL "ros")
      set(headers ${OTTER_NAV_PRECOMPILED_ROS})
    endif()
    otter_nav_add_precompiled(${kind} ${main} "${headers}" ${libraries})
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE" AND NOT kind STREQUAL "test")
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  if(kind STREQUAL "ros")
    # A compiler that can't use so large a file reads the headers themselves.
    target_compile_options(${target} PRIVATE -Wno-error=invalid-pch)
  endif()
  target_precompile_headers(${target} REUSE_FROM otter_nav_precompiled_${kind})
endfunction()

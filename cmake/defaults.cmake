# Compiler settings every target of the project shares.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(OTTER_NAV_LIBRARY_KIND STATIC)
if(OTTER_NAV_SHARED)
  set(OTTER_NAV_LIBRARY_KIND SHARED)
  include(GNUInstallDirs)
  set(CMAKE_INSTALL_RPATH ${CMAKE_INSTALL_FULL_LIBDIR}/otter_nav)
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# The interpreter of catkin's scripts must be Debian's: another python3 on PATH lacks catkin_pkg.
if(NOT DEFINED PYTHON_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python for catkin")
endif()

# Names of a room's anonymous namespaces differ for this.
set(CMAKE_UNITY_BUILD ${OTTER_NAV_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
if(OTTER_NAV_UNITY)
  # What lies hidden in a source counts as a header's here.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

find_program(OTTER_NAV_CCACHE ccache)
if(OTTER_NAV_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${OTTER_NAV_CCACHE})
endif()

add_compile_options(-Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wsuggest-override -Wzero-as-null-pointer-constant)
if(OTTER_NAV_WERROR)
  add_compile_options(-Werror)
endif()
if(OTTER_NAV_SANITIZE)
  add_compile_options(-O2 -fsanitize=address,undefined -fno-sanitize-recover=undefined
                      $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/sanitize_not.txt>
                      -fno-omit-frame-pointer
                      $<$<CXX_COMPILER_ID:GNU>:-Wno-mismatched-new-delete>)
  add_link_options(-fsanitize=address,undefined)
endif()
if(OTTER_NAV_NATIVE)
  include(CheckCXXSourceRuns)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") && __builtin_cpu_supports(\"bmi2\") ? 0 : 1; }"
                        OTTER_NAV_HAVE_AVX2)
  if(OTTER_NAV_HAVE_AVX2)
    # Alignment stays at 16 bytes so that Eigen types agree with the distribution's libraries.
    add_compile_options(-mavx2 -mfma -mbmi -mbmi2 -mlzcnt -mpopcnt)
    add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=16)
  endif()
endif()

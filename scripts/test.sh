#!/usr/bin/env bash
# Installs, builds and runs the unit, property, closed-loop and rostest suites: test.sh
# Last line: N passed, M failed. Exit code 0 only if nothing failed.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
for argument in "$@"; do
  case $argument in
    -h|--help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
    *) echo "test.sh: unknown argument '$argument'" >&2; exit 2 ;;
  esac
done
"$top/scripts/install_dependencies.sh" build test
echo "Building with tests (build/build.log has the details)"
"$top/scripts/build.sh" --tests

cd "$top"
rm -rf build/otter_nav/test_results build/otter_nav/Testing build/ctest.xml
set +u
# shellcheck disable=SC1091
. install/setup.bash
set -u
# All on this machine, whose own name may not be known to it.
unset ROS_IP
export ROS_HOSTNAME=localhost
# The ROS log of a run belongs to it; rostest finds a free port by itself.
ROS_LOG_DIR="$top/build/ros_log"
ROS_HOME="$top/build/ros_home"
export ROS_LOG_DIR ROS_HOME
ctest --test-dir build/otter_nav --output-on-failure --output-junit "$top/build/ctest.xml" -j 1 || true
exec /usr/bin/python3 scripts/count_tests.py build/ctest.xml build/otter_nav/test_results

#!/usr/bin/env bash
# Builds the package with colcon into build/ and install/ beside the sources: build.sh [--tests]
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
testing=OFF
[ "${1:-}" = "--tests" ] && testing=ON

cd "$top"
colcon --log-base log build --base-paths "$top" --build-base build --install-base install \
  --merge-install --event-handlers console_cohesion- desktop_notification- status- \
  --cmake-args -DCMAKE_BUILD_TYPE=Release -DPYTHON_EXECUTABLE=/usr/bin/python3 \
  -DCATKIN_ENABLE_TESTING=$testing

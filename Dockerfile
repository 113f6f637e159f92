# The README's two commands on a bare Debian 12, then a shell with everything built:
#   docker build -t otter_nav . && docker run --rm -it otter_nav
# --build-arg TESTS=no leaves the suites out.
FROM debian:12
ARG TESTS=yes
COPY . /otter_nav
WORKDIR /otter_nav
RUN scripts/mission.sh --no-rviz --speed 0
RUN if [ "$TESTS" = yes ]; then scripts/test.sh; fi
CMD ["bash", "--rcfile", "install/setup.bash"]

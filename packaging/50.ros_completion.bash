# Completion of rosrun, roslaunch and the like. Debian has it, under a name that bash does not look for.
if [[ $- == *i* && -r /usr/share/bash-completion/completions/rosbash ]]; then
  . /usr/share/bash-completion/completions/rosbash
fi

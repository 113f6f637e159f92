# Completion of `otter_nav PROGRAM --option`: programs from their folder, options from --help.
_otter_nav() {
  local cur prev words cword
  _init_completion || return
  local programs
  programs=$(dirname "$(dirname "$(readlink -f "$(command -v otter_nav)")")")/lib/otter_nav
  if [ "$cword" -eq 1 ]; then
    local names
    names=$(find "$programs/" -maxdepth 1 -perm -u+x \( -type f -o -type l \) ! -name '*_node' ! -name '*.py' -printf '%f ')
    mapfile -t COMPREPLY < <(compgen -W "--help $names" -- "$cur")
  elif [[ $cur == -* && -x $programs/${words[1]} ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_parse_help "$programs/${words[1]}" --help)" -- "$cur")
  elif [[ $prev == --vessel || $prev == --vessel-guess ]]; then
    local vessels=$programs/../../share/otter_nav/config/vessels
    mapfile -t COMPREPLY < <(compgen -W "$(basename -s .yaml -a "$vessels"/*.yaml)" -- "$cur")
    _filedir yaml
  elif [[ $prev == --disturbance ]]; then
    local presets=$programs/../../share/otter_nav/config/disturbances
    mapfile -t COMPREPLY < <(compgen -W "$(basename -s .yaml -a "$presets"/*.yaml)" -- "$cur")
  else
    _filedir
  fi
} && complete -F _otter_nav otter_nav

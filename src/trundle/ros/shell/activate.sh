# The commands of ROS 1 and Gazebo, first on PATH; trundle_deactivate undoes it. For bash, zsh and sh.

TRUNDLE_SHELL=@FOLDER@
PATH="$TRUNDLE_SHELL/bin:$PATH"
PYTHONPATH=@SITE@"${PYTHONPATH:+:$PYTHONPATH}" # ROS' Python packages, where none are installed
TRUNDLE_LIBRARIES=@LIBRARIES@ # for other Pythons of the same version
TRUNDLE_PYTHON=@PYTHON@
gazebo_DIR=@GAZEBO@ # CMake's find_package finds the development kit, where CMake runs alone
roscpp_DIR=@GAZEBO@
export TRUNDLE_SHELL PATH PYTHONPATH TRUNDLE_LIBRARIES TRUNDLE_PYTHON gazebo_DIR roscpp_DIR
if [ -z "${ROS_DISTRO+x}" ]; then
  ROS_DISTRO=noetic
  ROS_VERSION=1
  export ROS_DISTRO ROS_VERSION
  _trundle_distro=set
fi
if [ -z "${CMAKE_POLICY_VERSION_MINIMUM+x}" ]; then
  CMAKE_POLICY_VERSION_MINIMUM=3.5 # CMake 4 refuses the 2.8 of that era's packages
  export CMAKE_POLICY_VERSION_MINIMUM
  _trundle_policy=set
fi

roscd() {
  if [ "${1-}" = "--help" ] || [ "$#" -gt 1 ]; then
    printf 'usage: roscd package\n\nJump to target package.\n'
    return 0
  fi
  _trundle_target="$("$TRUNDLE_SHELL/bin/roscd" "$@")" && cd "${_trundle_target:-.}"
}

# PATH: where a file of /opt/ros/DISTRO/share/PACKAGE is here; itself, if nobody has the package
_trundle_shared() {
  _trundle_inside="${1#/opt/ros/*/share/}"
  _trundle_package="${_trundle_inside%%/*}"
  if _trundle_found="$("$TRUNDLE_SHELL/bin/rospack" find "$_trundle_package")"; then
    printf 'trundle: %s is %s here\n' "${1%"${_trundle_inside#"$_trundle_package"}"}" "$_trundle_found" >&2
    printf '%s' "$_trundle_found${_trundle_inside#"$_trundle_package"}"
  else
    printf '%s' "$1"
  fi
}

cp() {
  for _trundle_word; do
    shift
    case "$_trundle_word" in
      /opt/ros/*/share/?*) [ -e "$_trundle_word" ] || _trundle_word="$(_trundle_shared "$_trundle_word")" ;;
    esac
    set -- "$@" "$_trundle_word"
  done
  command cp "$@"
}

# LIST ENTRY: the list without the first such entry
_trundle_without() {
  _trundle_list=":$1:"
  case "$_trundle_list" in
    *":$2:"*) _trundle_list="${_trundle_list%%":$2:"*}:${_trundle_list#*":$2:"}" ;;
  esac
  _trundle_list="${_trundle_list#:}"
  printf '%s' "${_trundle_list%:}"
}

trundle_deactivate() {
  if [ -z "${TRUNDLE_SHELL-}" ]; then
    return 0
  fi
  PATH="$(_trundle_without "$PATH" "$TRUNDLE_SHELL/bin")"
  PYTHONPATH="$(_trundle_without "${PYTHONPATH-}" @SITE@)"
  if [ -z "$PYTHONPATH" ]; then
    unset PYTHONPATH
  fi
  rm -rf "$TRUNDLE_SHELL"
  if [ -n "${BASH_VERSION-}" ]; then
    complete -r @NAMES@ 2> /dev/null
    hash -r
  fi
  if [ -n "${_trundle_prompt+x}" ]; then
    PS1="$_trundle_prompt"
  fi
  if [ -n "${_trundle_distro-}" ]; then
    unset ROS_DISTRO ROS_VERSION
  fi
  if [ -n "${_trundle_policy-}" ]; then
    unset CMAKE_POLICY_VERSION_MINIMUM
  fi
  unset TRUNDLE_SHELL TRUNDLE_LIBRARIES TRUNDLE_PYTHON gazebo_DIR roscpp_DIR _trundle_prompt _trundle_distro _trundle_target
  unset _trundle_policy _trundle_word _trundle_inside _trundle_package _trundle_found
  unset -f roscd cp trundle_deactivate _trundle_without _trundle_shared
}

case $- in
  *i*)
    _trundle_prompt="${PS1-}"
    PS1="(trundle) ${PS1-}"
    ;;
esac

# Environment of a catkin workspace, written by Trundle's catkin_make.
#
# Undoes what the setup file of another workspace did, then puts this one, and those it was made on, first.
# CATKIN_SETUP_UTIL_ARGS or arguments: --extend keeps the other workspace, --local leaves those below out.

: "${_CATKIN_SETUP_DIR:=@DEVEL@}"

# LIST ENTRY: the list without the entry
_catkin_without() {
  _catkin_list=":$1:"
  while :; do
    case "$_catkin_list" in
      *":$2:"*) _catkin_list="${_catkin_list%%":$2:"*}:${_catkin_list#*":$2:"}" ;;
      *) break ;;
    esac
  done
  _catkin_list="${_catkin_list#:}"
  printf '%s' "${_catkin_list%:}"
}

# LIST ENTRY: the list with the entry first, if it exists
_catkin_first() {
  if [ ! -e "$2" ]; then
    printf '%s' "$1"
    return
  fi
  _catkin_rest="$(_catkin_without "$1" "$2")"
  printf '%s' "$2${_catkin_rest:+:$_catkin_rest}"
}

# FUNCTION PREFIX: applied to each variable for the folders of a prefix
_catkin_change() {
  CMAKE_PREFIX_PATH="$("$1" "${CMAKE_PREFIX_PATH:-}" "$2")"
  LD_LIBRARY_PATH="$("$1" "${LD_LIBRARY_PATH:-}" "$2/lib")"
  PATH="$("$1" "$PATH" "$2/bin")"
  PKG_CONFIG_PATH="$("$1" "${PKG_CONFIG_PATH:-}" "$2/lib/pkgconfig")"
  PYTHONPATH="$("$1" "${PYTHONPATH:-}" "$2/lib/python3/dist-packages")"
  if [ -s "$2/.catkin" ]; then
    ROS_PACKAGE_PATH="$("$1" "${ROS_PACKAGE_PATH:-}" "$(cat "$2/.catkin")")"
  elif [ -f "$2/.catkin" ]; then
    ROS_PACKAGE_PATH="$("$1" "${ROS_PACKAGE_PATH:-}" "$2/share")"
  fi
}

_catkin_args=" $* ${CATKIN_SETUP_UTIL_ARGS:-} "
case "$_catkin_args" in
  *" --extend "*) ;;
  *)
    _catkin_prefixes="${CMAKE_PREFIX_PATH:-}:"
    while [ -n "$_catkin_prefixes" ]; do
      _catkin_prefix="${_catkin_prefixes%%:*}"
      _catkin_prefixes="${_catkin_prefixes#*:}"
      if [ -n "$_catkin_prefix" ] && [ -f "$_catkin_prefix/.catkin" ]; then
        _catkin_change _catkin_without "$_catkin_prefix"
      fi
    done
    ;;
esac
_catkin_prefixes=@UNDERLAYS@
case "$_catkin_args" in
  *" --local "*) _catkin_prefixes= ;;
esac
while [ -n "$_catkin_prefixes" ]; do # the last one is the lowest, and goes in first
  _catkin_change _catkin_first "${_catkin_prefixes##*:}"
  case "$_catkin_prefixes" in
    *:*) _catkin_prefixes="${_catkin_prefixes%:*}" ;;
    *) _catkin_prefixes= ;;
  esac
done
_catkin_change _catkin_first "$_CATKIN_SETUP_DIR"
export CMAKE_PREFIX_PATH LD_LIBRARY_PATH PATH PKG_CONFIG_PATH PYTHONPATH ROS_PACKAGE_PATH
unset _CATKIN_SETUP_DIR _catkin_args _catkin_list _catkin_prefix _catkin_prefixes _catkin_rest
unset -f _catkin_without _catkin_first _catkin_change

# Environment of a catkin workspace, for bash; written by Trundle's catkin_make.
_CATKIN_SETUP_DIR="$(builtin cd "$(dirname "${BASH_SOURCE[0]}")" > /dev/null && pwd)"
. "$_CATKIN_SETUP_DIR/setup.sh"

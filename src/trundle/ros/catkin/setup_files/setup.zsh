# Environment of a catkin workspace, for zsh; written by Trundle's catkin_make.
_CATKIN_SETUP_DIR="${${(%):-%x}:A:h}"
emulate sh -c '. "$_CATKIN_SETUP_DIR/setup.sh"'

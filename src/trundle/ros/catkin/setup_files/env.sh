#!/bin/sh
# Runs a command in the environment of a catkin workspace; written by Trundle's catkin_make.
if [ $# -eq 0 ]; then
  echo "Usage: env.sh COMMANDS"
  echo "Calling env.sh without arguments is not supported anymore. Instead spawn a subshell and source a setup file manually."
  exit 1
fi
_CATKIN_SETUP_DIR="$(cd "$(dirname "$0")" > /dev/null && pwd)"
_catkin_setup="$_CATKIN_SETUP_DIR/setup.sh"
_catkin_run() { . "$_catkin_setup"; }
_catkin_run
exec "$@"

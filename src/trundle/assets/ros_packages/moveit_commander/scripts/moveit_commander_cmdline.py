#!/usr/bin/env python3
"""Commands to MoveIt, one a line."""

import argparse
import os
import sys

import rospy
from moveit_commander import MoveGroupCommandInterpreter, MoveGroupInfoLevel, roscpp_initialize, roscpp_shutdown

COLORS = {MoveGroupInfoLevel.FAIL: 91, MoveGroupInfoLevel.WARN: 93, MoveGroupInfoLevel.SUCCESS: 92}


class Completer:
    """Commands and their words, for the tab key."""

    def __init__(self, interpreter):
        self.interpreter = interpreter
        self.matches = []

    def complete(self, text, state):
        import readline

        if state == 0:
            keywords = {**self.interpreter.get_keywords(), "quit": []}
            words = readline.get_line_buffer()[: readline.get_begidx()].split()
            known = keywords.get(words[0], []) if words else keywords
            self.matches = sorted(word for word in known if word.startswith(text))
        return f"{self.matches[state]} " if state < len(self.matches) else None


def show(level, text):
    color = COLORS.get(level) if sys.stdout.isatty() else None
    print(f"\033[{color}m{text}\033[0m" if color else text, flush=True)


def read_commands(interpreter):
    """Execute what is typed, until quit or the end of the input."""
    try:
        import readline

        readline.set_completer(Completer(interpreter).complete)
        readline.parse_and_bind("tab: complete")
    except ImportError:  # Windows has none
        pass
    print("\nWaiting for commands. Type 'help' to get a list of known commands.\n", flush=True)
    while not rospy.is_shutdown():
        group = interpreter.get_active_group()
        try:
            command = input(f"{group.get_name() if group else ''}> ").strip()
        except (EOFError, KeyboardInterrupt):
            break
        if command.lower() in ("q", "quit", "exit"):
            break
        if command.lower() == "host":
            show(MoveGroupInfoLevel.INFO, f"Master is '{os.environ.get('ROS_MASTER_URI', '')}'")
        elif command:
            show(*interpreter.execute(command))


def main():
    parser = argparse.ArgumentParser(description="Command Line Interface to MoveIt")
    parser.add_argument("-i", "--interactive", action="store_true", help="read commands (default)")
    parser.add_argument("-s", "--service", action="store_true", help="only connect, until the node is shut down")
    parser.add_argument("group_name", nargs="?", default="", help="group to begin with")
    options = parser.parse_args(rospy.myargv()[1:])

    roscpp_initialize(sys.argv)
    rospy.init_node("move_group_interface_cmdline", anonymous=True, disable_signals=True)
    interpreter = MoveGroupCommandInterpreter()
    if options.group_name:
        show(*interpreter.execute(f"use {options.group_name}"))
    if options.service:
        rospy.spin()
    else:
        read_commands(interpreter)
    rospy.signal_shutdown("Done")
    roscpp_shutdown()
    print("Bye bye!")


if __name__ == "__main__":
    main()

# The commands of ROS 1 and Gazebo, first on PATH; trundle_deactivate undoes it. For fish.

set -gx TRUNDLE_SHELL @FOLDER@
set -gx PATH $TRUNDLE_SHELL/bin $PATH
set -gx --path PYTHONPATH @SITE@ $PYTHONPATH
set -gx TRUNDLE_LIBRARIES @LIBRARIES@
set -gx TRUNDLE_PYTHON @PYTHON@
set -gx gazebo_DIR @GAZEBO@
set -gx roscpp_DIR @GAZEBO@
if not set -q ROS_DISTRO
    set -gx ROS_DISTRO noetic
    set -gx ROS_VERSION 1
    set -g _trundle_distro set
end
if not set -q CMAKE_POLICY_VERSION_MINIMUM
    set -gx CMAKE_POLICY_VERSION_MINIMUM 3.5
    set -g _trundle_policy set
end

function roscd
    if test "$argv[1]" = --help; or test (count $argv) -gt 1
        printf 'usage: roscd package\n\nJump to target package.\n'
        return 0
    end
    set -l target ($TRUNDLE_SHELL/bin/roscd $argv); and cd $target
end

function cp
    set -l words
    for word in $argv
        set -l parts (string match -r '^(/opt/ros/[^/]+/share/([^/]+))(/.*)?$' -- $word)
        if test (count $parts) -ge 3; and not test -e $word
            if set -l found ($TRUNDLE_SHELL/bin/rospack find $parts[3])
                printf 'trundle: %s is %s here\n' $parts[2] $found >&2
                set word "$found$parts[4]"
            end
        end
        set -a words $word
    end
    command cp $words
end

function trundle_deactivate
    if not set -q TRUNDLE_SHELL
        return 0
    end
    set -gx PATH (string match -v -- $TRUNDLE_SHELL/bin $PATH)
    set -gx --path PYTHONPATH (string match -v -- @SITE@ $PYTHONPATH)
    rm -rf $TRUNDLE_SHELL
    if set -q _trundle_distro
        set -e ROS_DISTRO ROS_VERSION _trundle_distro
    end
    if set -q _trundle_policy
        set -e CMAKE_POLICY_VERSION_MINIMUM _trundle_policy
    end
    set -e TRUNDLE_SHELL TRUNDLE_LIBRARIES TRUNDLE_PYTHON gazebo_DIR roscpp_DIR
    functions -e roscd cp trundle_deactivate
end

// All of gazebo::common.
#ifndef GAZEBO_COMMON_COMMON_HH_
#define GAZEBO_COMMON_COMMON_HH_

#include <boost/lexical_cast.hpp>  // plugins use it without including it

#include <gazebo/common/Animation.hh>
#include <gazebo/common/Assert.hh>
#include <gazebo/common/Color.hh>
#include <gazebo/common/CommonIface.hh>
#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Event.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Exception.hh>
#include <gazebo/common/Image.hh>
#include <gazebo/common/KeyFrame.hh>
#include <gazebo/common/PID.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/common/SystemPaths.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/common/Timer.hh>
#include <gazebo/common/URI.hh>
#include <gazebo/common/UpdateInfo.hh>
#include <gazebo/util/system.hh>

#endif

#ifndef GAZEBO_COMMON_COMMONTYPES_HH_
#define GAZEBO_COMMON_COMMONTYPES_HH_

#include <map>
#include <memory>
#include <string>
#include <vector>

// Plugins name Boost's placeholders _1, _2, … without their namespace, as was usual then.
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#endif
#include <boost/bind.hpp>
#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>

#include <gazebo/gazebo_config.h>

#define GAZEBO_DEPRECATED(version)
#define GAZEBO_FORCEINLINE inline

namespace gazebo {

class WorldPlugin;
class ModelPlugin;
class SensorPlugin;
class SystemPlugin;
class VisualPlugin;
typedef boost::shared_ptr<WorldPlugin> WorldPluginPtr;
typedef boost::shared_ptr<ModelPlugin> ModelPluginPtr;
typedef boost::shared_ptr<SensorPlugin> SensorPluginPtr;
typedef boost::shared_ptr<SystemPlugin> SystemPluginPtr;
typedef boost::shared_ptr<VisualPlugin> VisualPluginPtr;

namespace common {

class Animation;
class NumericAnimation;
class PoseAnimation;
typedef boost::shared_ptr<Animation> AnimationPtr;
typedef boost::shared_ptr<NumericAnimation> NumericAnimationPtr;
typedef boost::shared_ptr<PoseAnimation> PoseAnimationPtr;
typedef std::vector<std::string> StringV;
typedef std::map<std::string, std::string> StrStr_M;

}  // namespace common

namespace event {

class Connection;
typedef std::shared_ptr<Connection> ConnectionPtr;
typedef std::vector<ConnectionPtr> Connection_V;

}  // namespace event
}  // namespace gazebo

#endif

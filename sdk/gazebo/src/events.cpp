#include <gazebo/common/Events.hh>

namespace gazebo {
namespace event {

EventT<void(std::string)> Events::addEntity;
EventT<void(std::string)> Events::deleteEntity;
EventT<void(std::string)> Events::worldCreated;
EventT<void()> Events::preRender;
EventT<void(const common::UpdateInfo&)> Events::worldUpdateBegin;
EventT<void(const common::UpdateInfo&)> Events::beforePhysicsUpdate;
EventT<void()> Events::worldUpdateEnd;
EventT<void()> Events::worldReset;
EventT<void()> Events::timeReset;

}  // namespace event
}  // namespace gazebo

// Events of the simulation; those of the window do not exist.
#ifndef GAZEBO_COMMON_EVENTS_HH_
#define GAZEBO_COMMON_EVENTS_HH_

#include <string>

#include <gazebo/common/Event.hh>
#include <gazebo/common/UpdateInfo.hh>

namespace gazebo {
namespace event {

class Events {
 public:
  template <typename T>
  static ConnectionPtr ConnectAddEntity(T subscriber) {
    return addEntity.Connect(subscriber);
  }
  static void DisconnectAddEntity(ConnectionPtr connection) { addEntity.Disconnect(connection); }
  static EventT<void(std::string)> addEntity;

  template <typename T>
  static ConnectionPtr ConnectDeleteEntity(T subscriber) {
    return deleteEntity.Connect(subscriber);
  }
  static void DisconnectDeleteEntity(ConnectionPtr connection) { deleteEntity.Disconnect(connection); }
  static EventT<void(std::string)> deleteEntity;

  // Called in plugins of the system alone, which are loaded before the others; with the world's name.
  template <typename T>
  static ConnectionPtr ConnectWorldCreated(T subscriber) {
    return worldCreated.Connect(subscriber);
  }
  static void DisconnectWorldCreated(ConnectionPtr connection) { worldCreated.Disconnect(connection); }
  static EventT<void(std::string)> worldCreated;

  // Before the cameras may draw, at each step: a function may activate one.
  template <typename T>
  static ConnectionPtr ConnectPreRender(T subscriber) {
    return preRender.Connect(subscriber);
  }
  static void DisconnectPreRender(ConnectionPtr connection) { preRender.Disconnect(connection); }
  static EventT<void()> preRender;

  template <typename T>
  static ConnectionPtr ConnectWorldUpdateBegin(T subscriber) {
    return worldUpdateBegin.Connect(subscriber);
  }
  static void DisconnectWorldUpdateBegin(ConnectionPtr connection) { worldUpdateBegin.Disconnect(connection); }
  static EventT<void(const common::UpdateInfo&)> worldUpdateBegin;

  template <typename T>
  static ConnectionPtr ConnectBeforePhysicsUpdate(T subscriber) {
    return beforePhysicsUpdate.Connect(subscriber);
  }
  static void DisconnectBeforePhysicsUpdate(ConnectionPtr connection) { beforePhysicsUpdate.Disconnect(connection); }
  static EventT<void(const common::UpdateInfo&)> beforePhysicsUpdate;

  template <typename T>
  static ConnectionPtr ConnectWorldUpdateEnd(T subscriber) {
    return worldUpdateEnd.Connect(subscriber);
  }
  static void DisconnectWorldUpdateEnd(ConnectionPtr connection) { worldUpdateEnd.Disconnect(connection); }
  static EventT<void()> worldUpdateEnd;

  template <typename T>
  static ConnectionPtr ConnectWorldReset(T subscriber) {
    return worldReset.Connect(subscriber);
  }
  static void DisconnectWorldReset(ConnectionPtr connection) { worldReset.Disconnect(connection); }
  static EventT<void()> worldReset;

  template <typename T>
  static ConnectionPtr ConnectTimeReset(T subscriber) {
    return timeReset.Connect(subscriber);
  }
  static void DisconnectTimeReset(ConnectionPtr connection) { timeReset.Disconnect(connection); }
  static EventT<void()> timeReset;
};

}  // namespace event
}  // namespace gazebo

#endif

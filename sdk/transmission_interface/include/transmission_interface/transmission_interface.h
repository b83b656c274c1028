#pragma once

#include <string>

#include <hardware_interface/internal/resource_manager.h>
#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_interface_exception.h>

namespace transmission_interface {

/** Transmission with the numbers on both of its sides. */
class TransmissionHandle {
 public:
  /** Throws TransmissionInterfaceException if the numbers do not fit the transmission. */
  TransmissionHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                     const JointData& joint_data)
      : name_(name), transmission_(transmission), actuator_data_(actuator_data), joint_data_(joint_data) {
    if (!transmission) throw TransmissionInterfaceException("Unspecified transmission.");
    require(actuator_data_, transmission->numActuators(), "actuator");
    require(joint_data_, transmission->numJoints(), "joint");
  }
  std::string getName() const { return name_; }

 protected:
  std::string name_;
  Transmission* transmission_;
  ActuatorData actuator_data_;
  JointData joint_data_;

 private:
  template <class Data>
  static void require(const Data& data, std::size_t count, const char* what) {
    const std::vector<double*>* const all[] = {&data.position, &data.velocity, &data.effort, &data.absolute_position,
                                               &data.torque_sensor};
    bool is_empty = true;
    for (const std::vector<double*>* const values : all) {
      if (values->empty()) continue;
      is_empty = false;
      if (values->size() != count)
        throw TransmissionInterfaceException(std::string(what) + " data does not have the transmission's size.");
      for (const double* const value : *values)
        if (!value) throw TransmissionInterfaceException(std::string(what) + " data has a null pointer.");
    }
    if (is_empty) throw TransmissionInterfaceException(std::string("All ") + what + " data vectors are empty.");
  }
};

class ActuatorToJointStateHandle : public TransmissionHandle {
 public:
  using TransmissionHandle::TransmissionHandle;
  void propagate() {
    transmission_->actuatorToJointPosition(actuator_data_, joint_data_);
    transmission_->actuatorToJointVelocity(actuator_data_, joint_data_);
    transmission_->actuatorToJointEffort(actuator_data_, joint_data_);
    if (!actuator_data_.absolute_position.empty() && transmission_->hasActuatorToJointAbsolutePosition())
      transmission_->actuatorToJointAbsolutePosition(actuator_data_, joint_data_);
    if (!actuator_data_.torque_sensor.empty() && transmission_->hasActuatorToJointTorqueSensor())
      transmission_->actuatorToJointTorqueSensor(actuator_data_, joint_data_);
  }
};
class JointToActuatorStateHandle : public TransmissionHandle {
 public:
  using TransmissionHandle::TransmissionHandle;
  void propagate() {
    transmission_->jointToActuatorPosition(joint_data_, actuator_data_);
    transmission_->jointToActuatorVelocity(joint_data_, actuator_data_);
    transmission_->jointToActuatorEffort(joint_data_, actuator_data_);
  }
};

/** Handle that calls one function of the transmission. */
template <void (Transmission::*Function)(const ActuatorData&, JointData&)>
class ActuatorToJointHandle : public TransmissionHandle {
 public:
  using TransmissionHandle::TransmissionHandle;
  void propagate() { (transmission_->*Function)(actuator_data_, joint_data_); }
};
template <void (Transmission::*Function)(const JointData&, ActuatorData&)>
class JointToActuatorHandle : public TransmissionHandle {
 public:
  using TransmissionHandle::TransmissionHandle;
  void propagate() { (transmission_->*Function)(joint_data_, actuator_data_); }
};
typedef ActuatorToJointHandle<&Transmission::actuatorToJointPosition> ActuatorToJointPositionHandle;
typedef ActuatorToJointHandle<&Transmission::actuatorToJointVelocity> ActuatorToJointVelocityHandle;
typedef ActuatorToJointHandle<&Transmission::actuatorToJointEffort> ActuatorToJointEffortHandle;
typedef JointToActuatorHandle<&Transmission::jointToActuatorPosition> JointToActuatorPositionHandle;
typedef JointToActuatorHandle<&Transmission::jointToActuatorVelocity> JointToActuatorVelocityHandle;
typedef JointToActuatorHandle<&Transmission::jointToActuatorEffort> JointToActuatorEffortHandle;

/** Handles of one kind, which are propagated together. */
template <class HandleType>
class TransmissionInterface : public hardware_interface::ResourceManager<HandleType> {
 public:
  /** Throws TransmissionInterfaceException if there is none of this name. */
  HandleType getHandle(const std::string& name) {
    try {
      return this->hardware_interface::ResourceManager<HandleType>::getHandle(name);
    } catch (const std::logic_error& error) {
      throw TransmissionInterfaceException(error.what());
    }
  }
  void propagate() {
    for (auto& entry : this->resource_map_) entry.second.propagate();
  }
};
class ActuatorToJointStateInterface : public TransmissionInterface<ActuatorToJointStateHandle> {};
class ActuatorToJointPositionInterface : public TransmissionInterface<ActuatorToJointPositionHandle> {};
class ActuatorToJointVelocityInterface : public TransmissionInterface<ActuatorToJointVelocityHandle> {};
class ActuatorToJointEffortInterface : public TransmissionInterface<ActuatorToJointEffortHandle> {};
class JointToActuatorStateInterface : public TransmissionInterface<JointToActuatorStateHandle> {};
class JointToActuatorPositionInterface : public TransmissionInterface<JointToActuatorPositionHandle> {};
class JointToActuatorVelocityInterface : public TransmissionInterface<JointToActuatorVelocityHandle> {};
class JointToActuatorEffortInterface : public TransmissionInterface<JointToActuatorEffortHandle> {};

}  // namespace transmission_interface

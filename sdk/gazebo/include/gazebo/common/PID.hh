// PID controller; the error is actual - desired, so that the command has the opposite sign.
#ifndef GAZEBO_COMMON_PID_HH_
#define GAZEBO_COMMON_PID_HH_

#include <gazebo/common/Time.hh>

namespace gazebo {
namespace common {

class PID {
 public:
  // The command is unlimited while cmd_max < cmd_min.
  PID(double p = 0.0, double i = 0.0, double d = 0.0, double i_max = 0.0, double i_min = 0.0, double cmd_max = -1.0,
      double cmd_min = 0.0);
  virtual ~PID() {}
  void Init(double p = 0.0, double i = 0.0, double d = 0.0, double i_max = 0.0, double i_min = 0.0,
            double cmd_max = -1.0, double cmd_min = 0.0);

  void SetPGain(double value) { p_ = value; }
  void SetIGain(double value) { i_ = value; }
  void SetDGain(double value) { d_ = value; }
  void SetIMax(double value) { i_max_ = value; }
  void SetIMin(double value) { i_min_ = value; }
  void SetCmdMax(double value) { cmd_max_ = value; }
  void SetCmdMin(double value) { cmd_min_ = value; }
  double GetPGain() const { return p_; }
  double GetIGain() const { return i_; }
  double GetDGain() const { return d_; }
  double GetIMax() const { return i_max_; }
  double GetIMin() const { return i_min_; }
  double GetCmdMax() const { return cmd_max_; }
  double GetCmdMin() const { return cmd_min_; }

  double Update(double error, Time dt);
  void SetCmd(double command) { command_ = command; }
  double GetCmd() { return command_; }
  void GetErrors(double& p, double& i, double& d) {
    p = p_error_;
    i = i_error_;
    d = d_error_;
  }
  void Reset();

 private:
  double p_, i_, d_, i_max_, i_min_, cmd_max_, cmd_min_;
  double p_last_, p_error_, i_error_, d_error_, command_;
};

}  // namespace common
}  // namespace gazebo

#endif

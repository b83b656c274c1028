#pragma once

#include <boost/function.hpp>

#include "ros/advertise_options.h"
#include "ros/advertise_service_options.h"
#include "ros/common.h"
#include "ros/forwards.h"
#include "ros/init.h"
#include "ros/names.h"
#include "ros/param.h"
#include "ros/publisher.h"
#include "ros/rate.h"
#include "ros/service_client.h"
#include "ros/service_client_options.h"
#include "ros/service_server.h"
#include "ros/spinner.h"
#include "ros/steady_timer.h"
#include "ros/subscribe_options.h"
#include "ros/subscriber.h"
#include "ros/timer.h"
#include "ros/wall_timer.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {

/** Namespace of topics, services and parameters. The first handle starts the node, the last one shuts it down. */
class NodeHandle {
 public:
  NodeHandle(const std::string& ns = std::string(), const M_string& remappings = M_string());
  NodeHandle(const NodeHandle& rhs);
  NodeHandle(const NodeHandle& parent, const std::string& ns);
  NodeHandle(const NodeHandle& parent, const std::string& ns, const M_string& remappings);
  ~NodeHandle();
  NodeHandle& operator=(const NodeHandle& rhs);

  void setCallbackQueue(CallbackQueueInterface* queue) { queue_ = queue; }
  CallbackQueueInterface* getCallbackQueue() const { return queue_ ? queue_ : globalQueue(); }
  const std::string& getNamespace() const { return namespace_; }
  const std::string& getUnresolvedNamespace() const { return unresolved_namespace_; }
  /** Absolute name in this handle's namespace; throws InvalidNameException. */
  std::string resolveName(const std::string& name, bool remap = true) const;

  // Topics

  template <class M>
  Publisher advertise(const std::string& topic, uint32_t queue_size, bool latch = false) {
    AdvertiseOptions options;
    options.template init<M>(topic, queue_size);
    options.latch = latch;
    return advertise(options);
  }
  template <class M>
  Publisher advertise(const std::string& topic, uint32_t queue_size, const SubscriberStatusCallback& connect_cb,
                      const SubscriberStatusCallback& disconnect_cb = SubscriberStatusCallback(),
                      const VoidConstPtr& tracked_object = VoidConstPtr(), bool latch = false) {
    AdvertiseOptions options;
    options.template init<M>(topic, queue_size, connect_cb, disconnect_cb);
    options.tracked_object = tracked_object;
    options.latch = latch;
    return advertise(options);
  }
  Publisher advertise(AdvertiseOptions& options);

  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*fp)(M), T* obj,
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template initByFullCallbackType<M>(topic, queue_size, boost::bind(fp, obj, _1));
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*fp)(const boost::shared_ptr<M const>&),
                       T* obj, const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template init<M>(topic, queue_size, boost::bind(fp, obj, _1));
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*fp)(M) const, T* obj,
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template initByFullCallbackType<M>(topic, queue_size, boost::bind(fp, obj, _1));
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       void (T::*fp)(const boost::shared_ptr<M const>&) const, T* obj,
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template init<M>(topic, queue_size, boost::bind(fp, obj, _1));
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*fp)(M), const boost::shared_ptr<T>& obj,
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template initByFullCallbackType<M>(topic, queue_size, boost::bind(fp, obj.get(), _1));
    options.tracked_object = obj;
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*fp)(const boost::shared_ptr<M const>&),
                       const boost::shared_ptr<T>& obj, const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template init<M>(topic, queue_size, boost::bind(fp, obj.get(), _1));
    options.tracked_object = obj;
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*fp)(M) const,
                       const boost::shared_ptr<T>& obj, const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template initByFullCallbackType<M>(topic, queue_size, boost::bind(fp, obj.get(), _1));
    options.tracked_object = obj;
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       void (T::*fp)(const boost::shared_ptr<M const>&) const, const boost::shared_ptr<T>& obj,
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template init<M>(topic, queue_size, boost::bind(fp, obj.get(), _1));
    options.tracked_object = obj;
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (*fp)(M),
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template initByFullCallbackType<M>(topic, queue_size, fp);
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (*fp)(const boost::shared_ptr<M const>&),
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template init<M>(topic, queue_size, fp);
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       const boost::function<void(const boost::shared_ptr<M const>&)>& callback,
                       const VoidConstPtr& tracked_object = VoidConstPtr(),
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template init<M>(topic, queue_size, callback);
    options.tracked_object = tracked_object;
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class C>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, const boost::function<void(C)>& callback,
                       const VoidConstPtr& tracked_object = VoidConstPtr(),
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template initByFullCallbackType<C>(topic, queue_size, callback);
    options.tracked_object = tracked_object;
    options.transport_hints = hints;
    return subscribe(options);
  }
  Subscriber subscribe(SubscribeOptions& options);

  // Services

  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*srv_func)(MReq&, MRes&), T* obj) {
    AdvertiseServiceOptions options;
    options.template init<MReq, MRes>(service, boost::bind(srv_func, obj, _1, _2));
    return advertiseService(options);
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*srv_func)(ServiceEvent<MReq, MRes>&), T* obj) {
    AdvertiseServiceOptions options;
    options.template initBySpecType<ServiceEventSpec<MReq, MRes> >(service, boost::bind(srv_func, obj, _1));
    return advertiseService(options);
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*srv_func)(MReq&, MRes&),
                                 const boost::shared_ptr<T>& obj) {
    AdvertiseServiceOptions options;
    options.template init<MReq, MRes>(service, boost::bind(srv_func, obj.get(), _1, _2));
    options.tracked_object = obj;
    return advertiseService(options);
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*srv_func)(ServiceEvent<MReq, MRes>&),
                                 const boost::shared_ptr<T>& obj) {
    AdvertiseServiceOptions options;
    options.template initBySpecType<ServiceEventSpec<MReq, MRes> >(service, boost::bind(srv_func, obj.get(), _1));
    options.tracked_object = obj;
    return advertiseService(options);
  }
  template <class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (*srv_func)(MReq&, MRes&)) {
    AdvertiseServiceOptions options;
    options.template init<MReq, MRes>(service, srv_func);
    return advertiseService(options);
  }
  template <class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (*srv_func)(ServiceEvent<MReq, MRes>&)) {
    AdvertiseServiceOptions options;
    options.template initBySpecType<ServiceEventSpec<MReq, MRes> >(service, srv_func);
    return advertiseService(options);
  }
  template <class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, const boost::function<bool(MReq&, MRes&)>& callback,
                                 const VoidConstPtr& tracked_object = VoidConstPtr()) {
    AdvertiseServiceOptions options;
    options.template init<MReq, MRes>(service, callback);
    options.tracked_object = tracked_object;
    return advertiseService(options);
  }
  template <class S>
  ServiceServer advertiseService(const std::string& service, const boost::function<bool(S&)>& callback,
                                 const VoidConstPtr& tracked_object = VoidConstPtr()) {
    AdvertiseServiceOptions options;
    options.template initBySpecType<ServiceEventSpec<typename S::RequestType, typename S::ResponseType> >(service,
                                                                                                          callback);
    options.tracked_object = tracked_object;
    return advertiseService(options);
  }
  ServiceServer advertiseService(AdvertiseServiceOptions& options);

  template <class MReq, class MRes>
  ServiceClient serviceClient(const std::string& service_name, bool persistent = false,
                              const M_string& header_values = M_string()) {
    ServiceClientOptions options;
    options.template init<MReq, MRes>(service_name, persistent, header_values);
    return serviceClient(options);
  }
  template <class Service>
  ServiceClient serviceClient(const std::string& service_name, bool persistent = false,
                              const M_string& header_values = M_string()) {
    ServiceClientOptions options;
    options.template init<Service>(service_name, persistent, header_values);
    return serviceClient(options);
  }
  ServiceClient serviceClient(ServiceClientOptions& options);

  // Timers

  template <class Handler, class Obj>
  Timer createTimer(Rate r, Handler h, Obj o, bool oneshot = false, bool autostart = true) {
    return createTimer(r.expectedCycleTime(), h, o, oneshot, autostart);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&), T* obj, bool oneshot = false,
                    bool autostart = true) {
    TimerOptions options(period, boost::bind(callback, obj, _1), nullptr, oneshot, autostart);
    return createTimer(options);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&) const, T* obj, bool oneshot = false,
                    bool autostart = true) {
    TimerOptions options(period, boost::bind(callback, obj, _1), nullptr, oneshot, autostart);
    return createTimer(options);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&), const boost::shared_ptr<T>& obj,
                    bool oneshot = false, bool autostart = true) {
    TimerOptions options(period, boost::bind(callback, obj.get(), _1), nullptr, oneshot, autostart);
    options.tracked_object = obj;
    return createTimer(options);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&) const, const boost::shared_ptr<T>& obj,
                    bool oneshot = false, bool autostart = true) {
    TimerOptions options(period, boost::bind(callback, obj.get(), _1), nullptr, oneshot, autostart);
    options.tracked_object = obj;
    return createTimer(options);
  }
  Timer createTimer(Duration period, const TimerCallback& callback, bool oneshot = false, bool autostart = true) {
    TimerOptions options(period, callback, nullptr, oneshot, autostart);
    return createTimer(options);
  }
  Timer createTimer(TimerOptions& options) const;

  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&), T* obj,
                            bool oneshot = false, bool autostart = true) {
    WallTimerOptions options(period, boost::bind(callback, obj, _1), nullptr, oneshot, autostart);
    return createWallTimer(options);
  }
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&) const, T* obj,
                            bool oneshot = false, bool autostart = true) {
    WallTimerOptions options(period, boost::bind(callback, obj, _1), nullptr, oneshot, autostart);
    return createWallTimer(options);
  }
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&),
                            const boost::shared_ptr<T>& obj, bool oneshot = false, bool autostart = true) {
    WallTimerOptions options(period, boost::bind(callback, obj.get(), _1), nullptr, oneshot, autostart);
    options.tracked_object = obj;
    return createWallTimer(options);
  }
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&) const,
                            const boost::shared_ptr<T>& obj, bool oneshot = false, bool autostart = true) {
    WallTimerOptions options(period, boost::bind(callback, obj.get(), _1), nullptr, oneshot, autostart);
    options.tracked_object = obj;
    return createWallTimer(options);
  }
  WallTimer createWallTimer(WallDuration period, const WallTimerCallback& callback, bool oneshot = false,
                            bool autostart = true) {
    WallTimerOptions options(period, callback, nullptr, oneshot, autostart);
    return createWallTimer(options);
  }
  WallTimer createWallTimer(WallTimerOptions& options) const;

  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period, void (T::*callback)(const SteadyTimerEvent&), T* obj,
                                bool oneshot = false, bool autostart = true) {
    SteadyTimerOptions options(period, boost::bind(callback, obj, _1), nullptr, oneshot, autostart);
    return createSteadyTimer(options);
  }
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period, void (T::*callback)(const SteadyTimerEvent&) const, T* obj,
                                bool oneshot = false, bool autostart = true) {
    SteadyTimerOptions options(period, boost::bind(callback, obj, _1), nullptr, oneshot, autostart);
    return createSteadyTimer(options);
  }
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period, void (T::*callback)(const SteadyTimerEvent&),
                                const boost::shared_ptr<T>& obj, bool oneshot = false, bool autostart = true) {
    SteadyTimerOptions options(period, boost::bind(callback, obj.get(), _1), nullptr, oneshot, autostart);
    options.tracked_object = obj;
    return createSteadyTimer(options);
  }
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period, void (T::*callback)(const SteadyTimerEvent&) const,
                                const boost::shared_ptr<T>& obj, bool oneshot = false, bool autostart = true) {
    SteadyTimerOptions options(period, boost::bind(callback, obj.get(), _1), nullptr, oneshot, autostart);
    options.tracked_object = obj;
    return createSteadyTimer(options);
  }
  SteadyTimer createSteadyTimer(WallDuration period, const SteadyTimerCallback& callback, bool oneshot = false,
                                bool autostart = true) {
    SteadyTimerOptions options(period, callback, nullptr, oneshot, autostart);
    return createSteadyTimer(options);
  }
  SteadyTimer createSteadyTimer(SteadyTimerOptions& options) const;

  // Parameters

  void setParam(const std::string& key, const XmlRpc::XmlRpcValue& value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const std::string& value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const char* value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, double value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, int value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, bool value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const std::vector<std::string>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::vector<double>& value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const std::vector<float>& value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const std::vector<int>& value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const std::vector<bool>& value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const std::map<std::string, std::string>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, double>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, float>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, int>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, bool>& value) const {
    param::set(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::string& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, double& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, float& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, int& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, bool& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, XmlRpc::XmlRpcValue& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<std::string>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<double>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<float>& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, std::vector<int>& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, std::vector<bool>& value) const { return param::get(resolveName(key), value); }
  bool getParam(const std::string& key, std::map<std::string, std::string>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, double>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, float>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, int>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, bool>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::string& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, double& value) const { return param::getCached(resolveName(key), value); }
  bool getParamCached(const std::string& key, float& value) const { return param::getCached(resolveName(key), value); }
  bool getParamCached(const std::string& key, int& value) const { return param::getCached(resolveName(key), value); }
  bool getParamCached(const std::string& key, bool& value) const { return param::getCached(resolveName(key), value); }
  bool getParamCached(const std::string& key, XmlRpc::XmlRpcValue& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<std::string>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<double>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<float>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<int>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<bool>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, std::string>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, double>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, float>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, int>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, bool>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool hasParam(const std::string& key) const { return param::has(resolveName(key)); }
  bool deleteParam(const std::string& key) const { return param::del(resolveName(key)); }
  bool searchParam(const std::string& key, std::string& result) const {
    // A search begins in a namespace; the key is not resolved, so it is remapped here.
    const M_string::const_iterator own = unresolved_remappings_.find(key);
    return param::search(resolveName(""), own == unresolved_remappings_.end() ? names::remap(key) : own->second,
                         result);
  }
  bool getParamNames(std::vector<std::string>& keys) const { return param::getParamNames(keys); }
  template <typename T>
  bool param(const std::string& name, T& value, const T& default_value) const {
    if (hasParam(name) && getParam(name, value)) return true;
    value = default_value;
    return false;
  }
  template <typename T>
  T param(const std::string& name, const T& default_value) const {
    T value;
    param(name, value, default_value);
    return value;
  }

  void shutdown();
  bool ok() const;

 private:
  void construct(const std::string& ns);
  void initRemappings(const M_string& remappings);
  static CallbackQueueInterface* globalQueue();

  std::string namespace_, unresolved_namespace_;
  M_string remappings_, unresolved_remappings_;
  CallbackQueueInterface* queue_ = nullptr;
  /** Publishers, subscribers, servers and timers of this handle, which shutdown() ends. */
  struct Endpoints;
  boost::shared_ptr<Endpoints> endpoints_;
};

}  // namespace ros

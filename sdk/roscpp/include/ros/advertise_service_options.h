#pragma once

#include "ros/common.h"
#include "ros/message_traits.h"
#include "ros/service_callback_helper.h"
#include "ros/service_traits.h"

namespace ros {

struct AdvertiseServiceOptions {
  template <class MReq, class MRes>
  void init(const std::string& service_, const boost::function<bool(MReq&, MRes&)>& callback) {
    initBySpecType<ServiceSpec<MReq, MRes> >(service_, callback);
  }
  template <class Service>
  void init(const std::string& service_,
            const boost::function<bool(typename Service::Request&, typename Service::Response&)>& callback) {
    initBySpecType<ServiceSpec<typename Service::Request, typename Service::Response> >(service_, callback);
  }
  template <class Spec>
  void initBySpecType(const std::string& service_, const typename Spec::CallbackType& callback) {
    typedef typename Spec::RequestType Request;
    typedef typename Spec::ResponseType Response;
    service = service_;
    md5sum = service_traits::md5sum<Request>();
    datatype = service_traits::datatype<Request>();
    req_datatype = message_traits::datatype<Request>();
    res_datatype = message_traits::datatype<Response>();
    helper = boost::make_shared<ServiceCallbackHelperT<Spec> >(callback);
  }
  template <class Service>
  static AdvertiseServiceOptions create(
      const std::string& service,
      const boost::function<bool(typename Service::Request&, typename Service::Response&)>& callback,
      const VoidConstPtr& tracked_object, CallbackQueueInterface* queue) {
    AdvertiseServiceOptions options;
    options.init<Service>(service, callback);
    options.tracked_object = tracked_object;
    options.callback_queue = queue;
    return options;
  }

  std::string service, md5sum, datatype, req_datatype, res_datatype;
  ServiceCallbackHelperPtr helper;
  CallbackQueueInterface* callback_queue = nullptr;
  VoidConstPtr tracked_object;
};

}  // namespace ros

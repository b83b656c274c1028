#pragma once

#include "ros/common.h"
#include "ros/message.h"
#include "ros/serialization.h"
#include "ros/service_traits.h"

namespace ros {

struct ServiceCallbackHelperCallParams {
  SerializedMessage request, response;
  boost::shared_ptr<M_string> connection_header;
};

/** Request, response and caller of a call. */
template <typename MReq, typename MRes>
class ServiceEvent {
 public:
  typedef MReq RequestType;
  typedef MRes ResponseType;
  typedef boost::shared_ptr<RequestType> RequestPtr;
  typedef boost::shared_ptr<ResponseType> ResponsePtr;
  typedef boost::function<bool(ServiceEvent<RequestType, ResponseType>&)> CallbackType;

  ServiceEvent(const boost::shared_ptr<MReq const>& req, const boost::shared_ptr<MRes>& res,
               const boost::shared_ptr<M_string>& connection_header)
      : request_(req), response_(res), connection_header_(connection_header) {}
  const RequestType& getRequest() const { return *request_; }
  ResponseType& getResponse() const { return *response_; }
  M_string& getConnectionHeader() const { return *connection_header_; }
  const std::string& getCallerName() const { return (*connection_header_)["callerid"]; }

 private:
  boost::shared_ptr<RequestType const> request_;
  boost::shared_ptr<ResponseType> response_;
  boost::shared_ptr<M_string> connection_header_;
};

template <typename MReq, typename MRes>
struct ServiceSpecCallParams {
  boost::shared_ptr<MReq> request;
  boost::shared_ptr<MRes> response;
  boost::shared_ptr<M_string> connection_header;
};

/** Callback with a request and a response. */
template <typename MReq, typename MRes>
struct ServiceSpec {
  typedef MReq RequestType;
  typedef MRes ResponseType;
  typedef boost::shared_ptr<RequestType> RequestPtr;
  typedef boost::shared_ptr<ResponseType> ResponsePtr;
  typedef boost::function<bool(RequestType&, ResponseType&)> CallbackType;
  static bool call(const CallbackType& callback, ServiceSpecCallParams<RequestType, ResponseType>& params) {
    return callback(*params.request, *params.response);
  }
};

/** Callback with a ServiceEvent. */
template <typename MReq, typename MRes>
struct ServiceEventSpec {
  typedef MReq RequestType;
  typedef MRes ResponseType;
  typedef typename ServiceEvent<MReq, MRes>::CallbackType CallbackType;
  static bool call(const CallbackType& callback, ServiceSpecCallParams<RequestType, ResponseType>& params) {
    ServiceEvent<RequestType, ResponseType> event(params.request, params.response, params.connection_header);
    return callback(event);
  }
};

class ServiceCallbackHelper {
 public:
  virtual ~ServiceCallbackHelper() {}
  virtual bool call(ServiceCallbackHelperCallParams& params) = 0;
};
typedef boost::shared_ptr<ServiceCallbackHelper> ServiceCallbackHelperPtr;

template <typename Spec>
class ServiceCallbackHelperT : public ServiceCallbackHelper {
 public:
  typedef typename Spec::RequestType RequestType;
  typedef typename Spec::ResponseType ResponseType;
  typedef typename Spec::CallbackType Callback;
  typedef boost::function<boost::shared_ptr<RequestType>()> ReqCreateFunction;
  typedef boost::function<boost::shared_ptr<ResponseType>()> ResCreateFunction;

  explicit ServiceCallbackHelperT(const Callback& callback) : callback_(callback) {}
  virtual bool call(ServiceCallbackHelperCallParams& params) {
    ServiceSpecCallParams<RequestType, ResponseType> call;
    call.request = boost::make_shared<RequestType>();
    call.response = boost::make_shared<ResponseType>();
    call.connection_header = params.connection_header;
    serialization::deserializeMessage(params.request, *call.request);
    const bool ok = Spec::call(callback_, call);
    if (ok) params.response = serialization::serializeServiceResponse(true, *call.response);
    return ok;
  }

 private:
  Callback callback_;
};

}  // namespace ros

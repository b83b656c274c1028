#pragma once

#include "ros/common.h"
#include "ros/service_traits.h"

namespace ros {

struct ServiceClientOptions {
  ServiceClientOptions() {}
  ServiceClientOptions(const std::string& service_, const std::string& md5sum_, bool persistent_,
                       const M_string& header_)
      : service(service_), md5sum(md5sum_), persistent(persistent_), header(header_) {}
  template <class MReq, class MRes>
  void init(const std::string& service_, bool persistent_, const M_string& header_) {
    service = service_;
    md5sum = service_traits::md5sum<MReq>();
    persistent = persistent_;
    header = header_;
  }
  template <class Service>
  void init(const std::string& service_, bool persistent_, const M_string& header_) {
    service = service_;
    md5sum = service_traits::md5sum<Service>();
    persistent = persistent_;
    header = header_;
  }

  std::string service, md5sum;
  /** True: the connection stays open between calls. */
  bool persistent = false;
  M_string header;
};

}  // namespace ros

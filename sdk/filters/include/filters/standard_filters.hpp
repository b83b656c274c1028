/** The filters that come with the package, by the names of its plugin description. */
#pragma once

#include <filters/increment.hpp>
#include <filters/mean.hpp>
#include <filters/median.hpp>
#include <filters/param_test.hpp>
#include <filters/transfer_function.hpp>

namespace filters {

/** A new filter of a type; null for those of plugins. The second argument only tells the base class. */
template <class Filter>
Filter* makeStandard(const std::string&, Filter*) {
  return nullptr;
}

inline FilterBase<double>* makeStandard(const std::string& type, FilterBase<double>*) {
  if (type == "filters/MeanFilterDouble") return new MeanFilter<double>;
  if (type == "filters/MedianFilterDouble") return new MedianFilter<double>;
  if (type == "filters/TransferFunctionFilterDouble") return new SingleChannelTransferFunctionFilter<double>;
  if (type == "filters/ParamTest") return new ParamTest<double>;
  return nullptr;
}

inline FilterBase<float>* makeStandard(const std::string& type, FilterBase<float>*) {
  if (type == "filters/MeanFilterFloat") return new MeanFilter<float>;
  if (type == "filters/MedianFilterFloat") return new MedianFilter<float>;
  return nullptr;
}

inline FilterBase<int>* makeStandard(const std::string& type, FilterBase<int>*) {
  return type == "filters/IncrementFilterInt" ? new IncrementFilter<int> : nullptr;
}

inline MultiChannelFilterBase<double>* makeStandard(const std::string& type, MultiChannelFilterBase<double>*) {
  if (type == "filters/MultiChannelMeanFilterDouble") return new MultiChannelMeanFilter<double>;
  if (type == "filters/MultiChannelMedianFilterDouble") return new MultiChannelMedianFilter<double>;
  if (type == "filters/MultiChannelTransferFunctionFilterDouble")
    return new MultiChannelTransferFunctionFilter<double>;
  return nullptr;
}

inline MultiChannelFilterBase<float>* makeStandard(const std::string& type, MultiChannelFilterBase<float>*) {
  if (type == "filters/MultiChannelMeanFilterFloat") return new MultiChannelMeanFilter<float>;
  if (type == "filters/MultiChannelMedianFilterFloat") return new MultiChannelMedianFilter<float>;
  return nullptr;
}

inline MultiChannelFilterBase<int>* makeStandard(const std::string& type, MultiChannelFilterBase<int>*) {
  return type == "filters/MultiChannelIncrementFilterInt" ? new MultiChannelIncrementFilter<int> : nullptr;
}

}  // namespace filters

#pragma once

#include <class_loader/class_loader.hpp>

/** Export a class as a plugin for its base; at file scope. */
#define PLUGINLIB_EXPORT_CLASS(class_type, base_class_type) CLASS_LOADER_REGISTER_CLASS(class_type, base_class_type)
#define PLUGINLIB_DECLARE_CLASS(package, class_name, class_type, base_class_type) \
  CLASS_LOADER_REGISTER_CLASS(class_type, base_class_type)
#define PLUGINLIB_REGISTER_CLASS(class_name, class_type, base_class_type) \
  CLASS_LOADER_REGISTER_CLASS(class_type, base_class_type)

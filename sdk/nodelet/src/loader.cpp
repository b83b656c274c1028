#include "nodelet/loader.h"

#include <bondcpp/bond.h>
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <pluginlib/class_loader.hpp>

namespace nodelet {

struct Loader::Impl {
  typedef boost::shared_ptr<Nodelet> NodeletPtr;
  struct Loaded {
    NodeletPtr nodelet;
    boost::shared_ptr<bond::Bond> bond;
  };

  std::mutex mutex;
  boost::function<NodeletPtr(const std::string&)> create;
  std::map<std::string, Loaded> loaded;
  ros::NodeHandle node;
  std::vector<ros::ServiceServer> services;
  ros::CallbackQueue bonds;
  boost::shared_ptr<ros::AsyncSpinner> bonds_spinner;

  void usePlugins() {
    const auto plugins = boost::make_shared<pluginlib::ClassLoader<Nodelet> >("nodelet", "nodelet::Nodelet");
    create = [plugins](const std::string& type) {
      if (!plugins->isClassAvailable(type)) plugins->refreshDeclaredClasses();
      return plugins->createInstance(type);
    };
  }

  void serve(const ros::NodeHandle& handle) {
    node = handle;
    services.push_back(node.advertiseService("load_nodelet", &Impl::onLoad, this));
    services.push_back(node.advertiseService("unload_nodelet", &Impl::onUnload, this));
    services.push_back(node.advertiseService("list", &Impl::onList, this));
  }

  bool load(const std::string& name, const std::string& type, const M_string& remappings, const V_string& my_argv) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (loaded.count(name)) {
      ROS_ERROR("Cannot load nodelet %s for one exists with that name already", name.c_str());
      return false;
    }
    try {
      const NodeletPtr nodelet = create(type);
      if (!nodelet) return false;
      ROS_DEBUG("Loading nodelet %s of type %s", name.c_str(), type.c_str());
      M_string resolved;
      for (const auto& pair : remappings) resolved[ros::names::resolve(pair.first)] = ros::names::resolve(pair.second);
      nodelet->init(name, resolved, my_argv);
      loaded[name].nodelet = nodelet;
      return true;
    } catch (const std::exception& error) {
      ROS_ERROR("Failed to load nodelet [%s] of type [%s]: %s", name.c_str(), type.c_str(), error.what());
      return false;
    }
  }

  bool unload(const std::string& name) {
    Loaded ended;  // destroyed without the lock: its callbacks may wait for it
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = loaded.find(name);
    if (found == loaded.end()) return false;
    ended = found->second;
    loaded.erase(found);
    return true;
  }

  bool onLoad(NodeletLoad::Request& request, NodeletLoad::Response& response) {
    M_string remappings;
    if (request.remap_source_args.size() != request.remap_target_args.size())
      ROS_ERROR("Bad remapping provided, target and source of different length");
    else
      for (size_t i = 0; i < request.remap_source_args.size(); ++i)
        remappings[request.remap_source_args[i]] = request.remap_target_args[i];
    response.success = load(request.name, request.type, remappings, request.my_argv);
    if (response.success && !request.bond_id.empty()) bind(request.name, request.bond_id);
    return response.success;
  }

  /** Unload a nodelet once the node that asked for it is gone. */
  void bind(const std::string& name, const std::string& id) {
    if (!bonds_spinner) {
      bonds_spinner.reset(new ros::AsyncSpinner(1, &bonds));
      bonds_spinner->start();
    }
    const auto bond = boost::make_shared<bond::Bond>(node.getNamespace() + "/bond", id);
    bond->setCallbackQueue(&bonds);
    bond->setBrokenCallback([this, name] {
      // A bond does not end in its own callback: another thread's unloads it.
      ROS_DEBUG("Bond of nodelet %s is broken", name.c_str());
      ros::getGlobalCallbackQueue()->addCallback(boost::make_shared<Unload>(*this, name),
                                                 reinterpret_cast<uint64_t>(this));
    });
    {
      const std::lock_guard<std::mutex> lock(mutex);
      loaded[name].bond = bond;
    }
    bond->start();
  }

  class Unload : public ros::CallbackInterface {
   public:
    Unload(Impl& impl, const std::string& name) : impl_(impl), name_(name) {}
    CallResult call() override {
      impl_.unload(name_);
      return Success;
    }

   private:
    Impl& impl_;
    std::string name_;
  };

  bool onUnload(NodeletUnload::Request& request, NodeletUnload::Response& response) {
    response.success = unload(request.name);
    if (!response.success) ROS_ERROR("Failed to find nodelet with name '%s' to unload.", request.name.c_str());
    return response.success;
  }

  bool onList(NodeletList::Request&, NodeletList::Response& response) {
    const std::lock_guard<std::mutex> lock(mutex);
    for (const auto& entry : loaded) response.nodelets.push_back(entry.first);
    return true;
  }
};

Loader::Loader(bool provide_ros_api) : impl_(boost::make_shared<Impl>()) {
  impl_->usePlugins();
  if (provide_ros_api) impl_->serve(ros::NodeHandle("~"));
}

Loader::Loader(const ros::NodeHandle& server_nh) : impl_(boost::make_shared<Impl>()) {
  impl_->usePlugins();
  impl_->serve(server_nh);
}

Loader::Loader(const boost::function<boost::shared_ptr<Nodelet>(const std::string& lookup_name)>& create_instance)
    : impl_(boost::make_shared<Impl>()) {
  impl_->create = create_instance;
}

Loader::~Loader() {
  for (ros::ServiceServer& service : impl_->services) service.shutdown();
  clear();
  ros::getGlobalCallbackQueue()->removeByID(reinterpret_cast<uint64_t>(impl_.get()));
  if (impl_->bonds_spinner) impl_->bonds_spinner->stop();
}

bool Loader::load(const std::string& name, const std::string& type, const M_string& remappings,
                  const V_string& my_argv) {
  return impl_->load(name, type, remappings, my_argv);
}

bool Loader::unload(const std::string& name) { return impl_->unload(name); }

bool Loader::clear() {
  for (const std::string& name : listLoadedNodelets()) impl_->unload(name);
  return true;
}

std::vector<std::string> Loader::listLoadedNodelets() {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  std::vector<std::string> names;
  for (const auto& entry : impl_->loaded) names.push_back(entry.first);
  return names;
}

}  // namespace nodelet

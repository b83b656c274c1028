// Loads plugins of this package and prints their areas, and what is wrong with the others.
#include <cpp_plugins/polygon.h>
#include <pluginlib/class_loader.h>

#include <iostream>

int main() {
  pluginlib::ClassLoader<shapes::Polygon> loader("cpp_plugins", "shapes::Polygon");
  for (const std::string& name : loader.getDeclaredClasses()) {
    std::cout << name << " " << loader.getName(name) << " " << loader.getClassPackage(name) << ": "
              << loader.getClassDescription(name) << std::endl;
    try {
      const boost::shared_ptr<shapes::Polygon> polygon = loader.createInstance(name);
      polygon->initialize(2.0);
      const pluginlib::UniquePtr<shapes::Polygon> other = loader.createUniqueInstance(name);
      other->initialize(3.0);
      std::cout << name << " " << polygon->area() << " " << other->area() << std::endl;
    } catch (const pluginlib::PluginlibException& error) {
      std::cout << "error: " << error.what() << std::endl;
    }
  }
  try {
    loader.createInstance("cpp_plugins/other");
  } catch (const pluginlib::LibraryLoadException& error) {
    std::cout << "error: " << error.what() << std::endl;
  }
  ROS_INFO("done");  // by what the header brings, as in the tutorial
  std::cout << loader.isClassLoaded("shapes::Square") << loader.unloadLibraryForClass("shapes::Square") << std::endl;
  return 0;
}

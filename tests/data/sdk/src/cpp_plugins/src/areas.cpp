// Loads plugins of this package and prints their areas, and what is wrong with the others.
#include <cpp_plugins/polygon.h>
#include <class_loader/multi_library_class_loader.hpp>
#include <pluginlib/class_loader.h>

#include <iostream>

// Classes of libraries by their paths: on demand, a library is given back with the last object of its classes.
void printLoads(const std::string& library) {
  std::cout << "loads " << class_loader::impl::isLibraryLoadedByAnybody(library);
  class_loader::MultiLibraryClassLoader loader(true);
  loader.loadLibrary(library);
  std::cout << class_loader::impl::isLibraryLoadedByAnybody(library);
  {
    const boost::shared_ptr<shapes::Polygon> square = loader.createInstance<shapes::Polygon>("shapes::Square");
    square->initialize(3.0);
    std::cout << class_loader::impl::isLibraryLoadedByAnybody(library) << " " << square->area() << " ";
  }
  {
    class_loader::ClassLoader single(library, true);
    const class_loader::ClassLoader::UniquePtr<shapes::Polygon> other =
        single.createUniqueInstance<shapes::Polygon>("shapes::Triangle");
    std::cout << single.isLibraryLoaded();
  }
  std::cout << loader.unloadLibrary(library) << class_loader::impl::isLibraryLoadedByAnybody(library) << " ";
  try {
    loader.createInstance<shapes::Polygon>("shapes::Square");
  } catch (const class_loader::CreateClassException& error) {
    std::cout << error.what() << std::endl;
  }
}

int main(int argc, char** argv) {
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
  try {
    pluginlib::ClassLoader<shapes::Polygon>("no_such_package", "shapes::Polygon");
  } catch (const pluginlib::ClassLoaderException& error) {
    std::cout << "error: " << error.what() << std::endl;
  }
  ROS_INFO("done");  // by what the header brings, as in the tutorial
  std::cout << loader.isClassLoaded("shapes::Square") << loader.unloadLibraryForClass("shapes::Square") << std::endl;
  if (argc > 1) printLoads(argv[1]);
  return 0;
}

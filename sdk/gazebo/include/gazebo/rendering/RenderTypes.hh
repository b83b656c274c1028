#ifndef GAZEBO_RENDERING_RENDERTYPES_HH_
#define GAZEBO_RENDERING_RENDERTYPES_HH_

#include <memory>

namespace gazebo {
namespace rendering {

class Visual;
class Scene;
class DynamicLines;
typedef std::shared_ptr<Visual> VisualPtr;
typedef std::shared_ptr<Scene> ScenePtr;
enum RenderOpType { RENDERING_POINT_LIST = 0, RENDERING_LINE_LIST = 1, RENDERING_LINE_STRIP = 2 };

}  // namespace rendering
}  // namespace gazebo

#endif

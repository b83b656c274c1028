#ifndef GAZEBO_RENDERING_RENDERTYPES_HH_
#define GAZEBO_RENDERING_RENDERTYPES_HH_

#include <memory>

#include <boost/shared_ptr.hpp>

// Who sees a visual; lines are seen on the page alone.
#define GZ_VISIBILITY_ALL 0x0FFFFFFF
#define GZ_VISIBILITY_SELECTION 0x10000000
#define GZ_VISIBILITY_GUI 0x00000001
#define GZ_VISIBILITY_SELECTABLE 0x00000002

namespace gazebo {
namespace rendering {

class Visual;
class Scene;
class DynamicLines;
class Camera;
class DepthCamera;
class Distortion;
typedef std::shared_ptr<Visual> VisualPtr;
typedef std::shared_ptr<Scene> ScenePtr;
typedef boost::shared_ptr<Camera> CameraPtr;
typedef boost::shared_ptr<DepthCamera> DepthCameraPtr;
typedef boost::shared_ptr<Distortion> DistortionPtr;
enum RenderOpType { RENDERING_POINT_LIST = 0, RENDERING_LINE_LIST = 1, RENDERING_LINE_STRIP = 2 };

}  // namespace rendering
}  // namespace gazebo

#endif

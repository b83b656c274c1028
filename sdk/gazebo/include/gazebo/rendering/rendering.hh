#ifndef GAZEBO_RENDERING_RENDERING_HH_
#define GAZEBO_RENDERING_RENDERING_HH_

#include <gazebo/rendering/Camera.hh>
#include <gazebo/rendering/DepthCamera.hh>
#include <gazebo/rendering/DynamicLines.hh>
#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/rendering/Visual.hh>

#endif

#ifndef GAZEBO_RENDERING_DISTORTION_HH_
#define GAZEBO_RENDERING_DISTORTION_HH_

#include <gazebo/rendering/Camera.hh>

#endif

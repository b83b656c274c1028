// Nothing: the page and cameras draw the world, and plugins have visuals of their own and lines. A plugin that uses a
// scene is not compiled, as the class has no members.
#ifndef GAZEBO_RENDERING_SCENE_HH_
#define GAZEBO_RENDERING_SCENE_HH_

#include <gazebo/rendering/RenderTypes.hh>

#endif

// What plugins of Gazebo include first: everything.
#ifndef GAZEBO_GAZEBO_HH_
#define GAZEBO_GAZEBO_HH_

#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <boost/bind.hpp>
#include <boost/function.hpp>
#include <boost/pointer_cast.hpp>
#include <boost/shared_ptr.hpp>
#include <boost/thread.hpp>

#include <gazebo/gazebo_config.h>
#include <gazebo/common/common.hh>
#include <gazebo/gazebo_core.hh>
#include <gazebo/math/gzmath.hh>

#endif

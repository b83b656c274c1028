#pragma once

#include "eigen_stl_containers/eigen_stl_map_container.h"
#include "eigen_stl_containers/eigen_stl_vector_container.h"

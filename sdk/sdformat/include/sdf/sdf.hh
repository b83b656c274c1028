#ifndef SDF_SDF_HH_
#define SDF_SDF_HH_

#include <ignition/math.hh>  // plugins use it without including it

#include <sdf/Element.hh>
#include <sdf/Param.hh>
#include <sdf/Types.hh>

#endif

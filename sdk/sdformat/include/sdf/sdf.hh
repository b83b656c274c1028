#ifndef SDF_SDF_HH_
#define SDF_SDF_HH_

// Plugins use these without including them.
#include <boost/algorithm/string.hpp>
#include <ignition/math.hh>

#include <sdf/Element.hh>
#include <sdf/Param.hh>
#include <sdf/SDFImpl.hh>
#include <sdf/Types.hh>

#endif

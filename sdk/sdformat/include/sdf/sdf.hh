#ifndef SDF_SDF_HH_
#define SDF_SDF_HH_

#include <sdf/Element.hh>
#include <sdf/Param.hh>
#include <sdf/Types.hh>

#endif

#ifndef SDF_PARSER_HH_
#define SDF_PARSER_HH_
#include <sdf/SDFImpl.hh>
#endif

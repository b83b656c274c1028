#ifndef SDF_TYPES_HH_
#define SDF_TYPES_HH_

#include <memory>
#include <string>
#include <vector>

#define SDF_VERSION "1.7"

namespace sdf {

class Element;
class Param;
typedef std::shared_ptr<Element> ElementPtr;
typedef std::shared_ptr<const Element> ElementConstPtr;
typedef std::weak_ptr<Element> ElementWeakPtr;
typedef std::vector<ElementPtr> ElementPtr_V;
typedef std::shared_ptr<Param> ParamPtr;
typedef std::vector<ParamPtr> Param_V;

}  // namespace sdf

#endif

// A document of SDF.
#ifndef SDF_SDFIMPL_HH_
#define SDF_SDFIMPL_HH_

#include <string>

#include <sdf/Element.hh>
#include <sdf/Types.hh>

namespace sdf {

class SDF {
 public:
  SDF() : root(std::make_shared<Element>()) { root->SetName("sdf"); }
  ElementPtr Root() const { return root; }
  void Root(const ElementPtr& element) { root = element; }
  // Read a text; what cannot be read leaves an empty document, with a line on standard error.
  void SetFromString(const std::string& text);
  std::string ToString() const { return root->ToString(""); }
  void PrintValues() const { root->PrintValues(""); }
  static std::string Version() { return SDF_VERSION; }

  ElementPtr root;
};
typedef std::shared_ptr<SDF> SDFPtr;

// Elements need no description here.
inline bool init(SDFPtr) { return true; }
inline bool initFile(const std::string&, SDFPtr) { return true; }
inline bool initFile(const std::string&, ElementPtr) { return true; }
// Read a text or a file; false if it cannot be read.
bool readString(const std::string& text, SDFPtr sdf);
bool readString(const std::string& text, ElementPtr element);
bool readFile(const std::string& filename, SDFPtr sdf);

}  // namespace sdf

#endif

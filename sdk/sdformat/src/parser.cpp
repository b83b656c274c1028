#include <boost/property_tree/detail/rapidxml.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>

#include <sdf/SDFImpl.hh>

namespace sdf {

namespace {

namespace xml = boost::property_tree::detail::rapidxml;

void fill(Element& element, const xml::xml_node<char>& node) {
  element.SetName(std::string(node.name(), node.name_size()));
  for (const xml::xml_attribute<char>* a = node.first_attribute(); a; a = a->next_attribute()) {
    const std::string key(a->name(), a->name_size());
    element.AddAttribute(key, "string", std::string(a->value(), a->value_size()), false);
  }
  bool has_elements = false;
  for (const xml::xml_node<char>* child = node.first_node(); child; child = child->next_sibling()) {
    if (child->type() != xml::node_element) continue;
    const ElementPtr inside = std::make_shared<Element>();
    fill(*inside, *child);
    inside->SetParent(element.shared_from_this());
    element.InsertElement(inside);
    has_elements = true;
  }
  if (!has_elements) element.AddValue("string", std::string(node.value(), node.value_size()), false);
}

}  // namespace

bool readString(const std::string& text, ElementPtr element) {
  std::string bytes = text;  // which the parser writes into
  bytes.push_back('\0');
  try {
    xml::xml_document<char> document;
    document.parse<xml::parse_trim_whitespace>(&bytes[0]);
    const xml::xml_node<char>* const first = document.first_node();
    if (!first) throw xml::parse_error("there is no element", &bytes[0]);
    element->Clear();
    fill(*element, *first);
    return true;
  } catch (const xml::parse_error& error) {
    const auto line = 1 + std::count(&bytes[0], error.where<char>(), '\n');
    std::cerr << "sdf: line " << line << " of a text: " << error.what() << std::endl;
    return false;
  }
}

bool readString(const std::string& text, SDFPtr sdf) { return readString(text, sdf->root); }

bool readFile(const std::string& filename, SDFPtr sdf) {
  std::ifstream in(filename, std::ios::binary);
  if (!in) {
    std::cerr << "sdf: " << filename << " cannot be opened" << std::endl;
    return false;
  }
  return readString(std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()), sdf);
}

void SDF::SetFromString(const std::string& text) {
  const ElementPtr read = std::make_shared<Element>();
  read->SetName("sdf");
  readString(text, read);
  root = read;
}

}  // namespace sdf

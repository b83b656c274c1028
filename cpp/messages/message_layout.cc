#include "message_layout.h"

#include <algorithm>
#include <iterator>

namespace trundle::messages {

namespace {

constexpr struct {
  const char* name;
  Kind kind;
} kTypes[] = {
    {"bool", Kind::kBool},       {"int8", Kind::kInt8},
    {"byte", Kind::kInt8},       {"uint8", Kind::kUInt8},
    {"char", Kind::kUInt8},      {"int16", Kind::kInt16},
    {"uint16", Kind::kUInt16},   {"int32", Kind::kInt32},
    {"uint32", Kind::kUInt32},   {"int64", Kind::kInt64},
    {"uint64", Kind::kUInt64},   {"float32", Kind::kFloat32},
    {"float64", Kind::kFloat64}, {"string", Kind::kString},
    {"message", Kind::kMessage}, {"placeholder", Kind::kPlaceholder},
};

Kind kind_of(const std::string& type) {
  const auto match =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](auto& entry) { return entry.name == type; });
  if (match == std::end(kTypes)) raise_error(PyExc_ValueError, "no field can be a %s", type.c_str());
  return match->kind;
}

}  // namespace

void MessageCodec::add(Object type, std::vector<FieldSpec> fields) {
  if (!PyType_Check(type.get())) raise_error(PyExc_TypeError, "a message's type is a class");
  auto layout = std::make_unique<Layout>();
  layout->type = std::move(type);
  for (FieldSpec& spec : fields) {
    Field field{std::move(spec.name), kind_of(spec.type), spec.count, nullptr, 0};
    PyObject* name = field.name.release();
    PyUnicode_InternInPlace(&name);
    field.name.reset(name);
    const uint64_t repeats = field.count == kScalar     ? 1
                             : field.count == kVariable ? 0
                                                        : static_cast<uint64_t>(field.count);
    if (field.count < kVariable || repeats > UINT32_MAX) raise_error(PyExc_ValueError, "'%U' has no such length", name);
    if (field.kind == Kind::kMessage) {
      if (spec.message >= layouts_.size()) raise_error(PyExc_ValueError, "'%U' is of a type not yet declared", name);
      field.message = layouts_[spec.message].get();
      field.min_size = field.message->min_size;
      if (field.min_size == 0) layout->empty_messages += repeats * field.message->empty_messages;
      if (layout->empty_messages > kMaxEmpty)
        raise_error(PyExc_ValueError, "'%U' holds too many messages without bytes", name);
    } else if (field.kind != Kind::kPlaceholder) {
      field.min_size = is_number(field.kind) ? bytes_of(field.kind) : sizeof(uint32_t);
    }
    layout->min_size += field.count == kVariable ? sizeof(uint32_t) : repeats * field.min_size;
    if (layout->min_size > UINT32_MAX) raise_error(PyExc_ValueError, "'%U' makes it longer than 4 GiB", name);
    layout->fields.push_back(std::move(field));
  }
  layouts_.push_back(std::move(layout));
}

}  // namespace trundle::messages

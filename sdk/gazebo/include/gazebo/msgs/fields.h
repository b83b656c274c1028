// Accessors of messages, as Protobuf's compiler names them.
#ifndef GAZEBO_MSGS_FIELDS_H_
#define GAZEBO_MSGS_FIELDS_H_

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// A number or a text.
#define TRUNDLE_FIELD(type, name) TRUNDLE_FIELD_FROM(type, name, type())

// One with a default.
#define TRUNDLE_FIELD_FROM(type, name, initial)     \
 public:                                            \
  bool has_##name() const { return has_##name##_; } \
  const type& name() const { return name##_; }      \
  void set_##name(const type& value) {              \
    name##_ = value;                                \
    has_##name##_ = true;                           \
  }                                                 \
  void clear_##name() {                             \
    name##_ = initial;                              \
    has_##name##_ = false;                          \
  }                                                 \
                                                    \
 private:                                           \
  type name##_ = initial;                           \
  bool has_##name##_ = false;

// A message inside.
#define TRUNDLE_MESSAGE(type, name)                 \
 public:                                            \
  bool has_##name() const { return has_##name##_; } \
  const type& name() const { return name##_; }      \
  type* mutable_##name() {                          \
    has_##name##_ = true;                           \
    return &name##_;                                \
  }                                                 \
  void set_allocated_##name(type* value) {          \
    clear_##name();                                 \
    if (value) *mutable_##name() = *value;          \
    delete value;                                   \
  }                                                 \
  void clear_##name() {                             \
    name##_ = type();                               \
    has_##name##_ = false;                          \
  }                                                 \
                                                    \
 private:                                           \
  type name##_;                                     \
  bool has_##name##_ = false;

// Numbers or texts.
#define TRUNDLE_FIELDS(type, name)                                                                                 \
 public:                                                                                                           \
  int name##_size() const { return static_cast<int>(name##_.size()); }                                             \
  const std::vector<type>& name() const { return name##_; }                                                        \
  std::vector<type>::const_reference name(int index) const { return name##_.at(static_cast<std::size_t>(index)); } \
  std::vector<type>* mutable_##name() { return &name##_; }                                                         \
  void set_##name(int index, const type& value) { name##_.at(static_cast<std::size_t>(index)) = value; }           \
  void add_##name(const type& value) { name##_.push_back(value); }                                                 \
  void clear_##name() { name##_.clear(); }                                                                         \
                                                                                                                   \
 private:                                                                                                          \
  std::vector<type> name##_;

// Messages inside.
#define TRUNDLE_MESSAGES(type, name)                                                        \
 public:                                                                                    \
  int name##_size() const { return static_cast<int>(name##_.size()); }                      \
  const std::vector<type>& name() const { return name##_; }                                 \
  std::vector<type>* mutable_##name() { return &name##_; }                                  \
  const type& name(int index) const { return name##_.at(static_cast<std::size_t>(index)); } \
  type* mutable_##name(int index) { return &name##_.at(static_cast<std::size_t>(index)); }  \
  type* add_##name() {                                                                      \
    name##_.emplace_back();                                                                 \
    return &name##_.back();                                                                 \
  }                                                                                         \
  void clear_##name() { name##_.clear(); }                                                  \
                                                                                            \
 private:                                                                                   \
  std::vector<type> name##_;

// The message itself.
#define TRUNDLE_WHOLE(type)                           \
 public:                                              \
  void Clear() { *this = type(); }                    \
  void CopyFrom(const type& other) { *this = other; } \
  void Swap(type* other) { std::swap(*this, *other); }

#endif

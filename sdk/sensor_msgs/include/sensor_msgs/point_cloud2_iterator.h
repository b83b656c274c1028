#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <cstdarg>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensor_msgs {

/** Bytes of a field's value; throws std::runtime_error for an unknown type. */
inline int sizeOfPointField(int datatype) {
  switch (datatype) {
    case PointField::INT8:
    case PointField::UINT8: return 1;
    case PointField::INT16:
    case PointField::UINT16: return 2;
    case PointField::INT32:
    case PointField::UINT32:
    case PointField::FLOAT32: return 4;
    case PointField::FLOAT64: return 8;
    default: throw std::runtime_error("PointField of type " + std::to_string(datatype) + " does not exist");
  }
}
/** Add a field at an offset [bytes]; the offset after it is returned. */
inline int addPointField(PointCloud2& cloud, const std::string& name, int count, int datatype, int offset) {
  PointField field;
  field.name = name;
  field.count = static_cast<uint32_t>(count);
  field.datatype = static_cast<uint8_t>(datatype);
  field.offset = static_cast<uint32_t>(offset);
  cloud.fields.push_back(field);
  return offset + count * sizeOfPointField(datatype);
}

/** Sets the fields and the size of a cloud. */
class PointCloud2Modifier {
 public:
  explicit PointCloud2Modifier(PointCloud2& cloud) : cloud_(cloud) {}

  size_t size() const { return static_cast<size_t>(cloud_.width) * cloud_.height; }
  void reserve(size_t size) { cloud_.data.reserve(size * cloud_.point_step); }
  void resize(size_t size) {
    cloud_.data.resize(size * cloud_.point_step);
    if (cloud_.height > 1 && size == static_cast<size_t>(cloud_.width) * cloud_.height) return;
    cloud_.height = 1;
    cloud_.width = static_cast<uint32_t>(size);
    cloud_.row_step = cloud_.width * cloud_.point_step;
  }
  void clear() { resize(0); }

  /** Set the fields: for each its name, count and type, such as ("x", 1, FLOAT32). */
  void setPointCloud2Fields(int n_fields, ...) {
    cloud_.fields.clear();
    int offset = 0;
    va_list arguments;
    va_start(arguments, n_fields);
    for (int i = 0; i < n_fields; ++i) {
      const std::string name(va_arg(arguments, char*));
      const int count = va_arg(arguments, int), datatype = va_arg(arguments, int);
      offset = addPointField(cloud_, name, count, datatype, offset);
    }
    va_end(arguments);
    setStep(offset);
  }
  /** Set the fields by the names "xyz", "rgb" and "rgba"; each takes 16 bytes, as in PCL. */
  void setPointCloud2FieldsByString(int n_fields, ...) {
    cloud_.fields.clear();
    int offset = 0;
    va_list arguments;
    va_start(arguments, n_fields);
    for (int i = 0; i < n_fields; ++i) {
      const std::string name(va_arg(arguments, char*));
      if (name == "xyz") {
        for (const char* const axis : {"x", "y", "z"})
          offset = addPointField(cloud_, axis, 1, PointField::FLOAT32, offset);
        offset += sizeOfPointField(PointField::FLOAT32);
      } else if (name == "rgb" || name == "rgba") {
        offset =
            addPointField(cloud_, name, 1, PointField::FLOAT32, offset) + 3 * sizeOfPointField(PointField::FLOAT32);
      } else {
        va_end(arguments);
        throw std::runtime_error("Field " + name + " does not exist");
      }
    }
    va_end(arguments);
    setStep(offset);
  }

 private:
  void setStep(int step) {
    cloud_.point_step = static_cast<uint32_t>(step);
    cloud_.row_step = cloud_.width * cloud_.point_step;
    cloud_.data.resize(static_cast<size_t>(cloud_.height) * cloud_.row_step);
  }
  PointCloud2& cloud_;
};

/** Iterator over a field of all points: `*it`, and `it[k]` for the fields after it. */
template <class T, class Byte, class Cloud>
class PointCloud2FieldIterator {
 public:
  PointCloud2FieldIterator() {}
  /** Throws std::runtime_error if the cloud has no such field, or fewer bytes than points. */
  PointCloud2FieldIterator(Cloud& cloud, const std::string& field) : step_(cloud.point_step) {
    const size_t offset = offsetOf(cloud, field);
    const size_t points = static_cast<size_t>(cloud.width) * cloud.height;
    if (cloud.data.size() / (step_ ? step_ : 1) < points || (points && offset + sizeof(T) > step_))
      throw std::runtime_error("The cloud has fewer bytes than its points need");
    at_ = cloud.data.data() + offset;
    end_ = at_ + points * step_;
  }
  T& operator*() const { return *reinterpret_cast<T*>(at_); }
  T& operator[](size_t i) const { return reinterpret_cast<T*>(at_)[i]; }
  PointCloud2FieldIterator& operator++() {
    at_ += step_;
    return *this;
  }
  PointCloud2FieldIterator operator+(int i) const {
    PointCloud2FieldIterator result = *this;
    return result += i;
  }
  PointCloud2FieldIterator& operator+=(int i) {
    at_ += static_cast<ptrdiff_t>(i) * static_cast<ptrdiff_t>(step_);
    return *this;
  }
  bool operator==(const PointCloud2FieldIterator& other) const { return at_ == other.at_; }
  bool operator!=(const PointCloud2FieldIterator& other) const { return at_ != other.at_; }
  PointCloud2FieldIterator end() const {
    PointCloud2FieldIterator result = *this;
    result.at_ = end_;
    return result;
  }

 private:
  /** Offset of a field; r, g, b and a are bytes of rgb. */
  static size_t offsetOf(const Cloud& cloud, const std::string& name) {
    for (const PointField& field : cloud.fields)
      if (field.name == name) return field.offset;
    const std::string bytes = cloud.is_bigendian ? "argb" : "bgra";
    if (name.size() == 1 && bytes.find(name) != std::string::npos)
      for (const PointField& field : cloud.fields)
        if (field.name == "rgb" || field.name == "rgba") return field.offset + bytes.find(name);
    throw std::runtime_error("Field " + name + " does not exist");
  }

  size_t step_ = 0;
  Byte *at_ = nullptr, *end_ = nullptr;
};

template <class T>
class PointCloud2Iterator : public PointCloud2FieldIterator<T, uint8_t, PointCloud2> {
 public:
  PointCloud2Iterator(PointCloud2& cloud, const std::string& field)
      : PointCloud2FieldIterator<T, uint8_t, PointCloud2>(cloud, field) {}
};
template <class T>
class PointCloud2ConstIterator : public PointCloud2FieldIterator<const T, const uint8_t, const PointCloud2> {
 public:
  PointCloud2ConstIterator(const PointCloud2& cloud, const std::string& field)
      : PointCloud2FieldIterator<const T, const uint8_t, const PointCloud2>(cloud, field) {}
};

}  // namespace sensor_msgs

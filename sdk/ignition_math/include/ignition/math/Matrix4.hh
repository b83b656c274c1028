// Matrix of 4 rows and columns; an affine one maps points between frames.
#ifndef IGNITION_MATH_MATRIX4_HH_
#define IGNITION_MATH_MATRIX4_HH_

#include <ignition/math/Matrix3.hh>
#include <ignition/math/Pose3.hh>

namespace ignition {
namespace math {

template <typename T>
class Matrix4 {
 public:
  static const Matrix4 Identity, Zero;

  Matrix4() : data{} {}
  Matrix4(T v00, T v01, T v02, T v03, T v10, T v11, T v12, T v13, T v20, T v21, T v22, T v23, T v30, T v31, T v32,
          T v33)
      : data{{v00, v01, v02, v03}, {v10, v11, v12, v13}, {v20, v21, v22, v23}, {v30, v31, v32, v33}} {}
  explicit Matrix4(const Quaternion<T>& rotation) : data{} {
    const Matrix3<T> m(rotation);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) data[row][column] = m(row, column);
    data[3][3] = T(1);
  }
  explicit Matrix4(const Pose3<T>& pose) : Matrix4(pose.Rot()) { SetTranslation(pose.Pos()); }

  void Set(T v00, T v01, T v02, T v03, T v10, T v11, T v12, T v13, T v20, T v21, T v22, T v23, T v30, T v31, T v32,
           T v33) {
    *this = Matrix4(v00, v01, v02, v03, v10, v11, v12, v13, v20, v21, v22, v23, v30, v31, v32, v33);
  }
  void Translate(const Vector3<T>& t) { SetTranslation(t); }
  void SetTranslation(const Vector3<T>& t) {
    for (int row = 0; row < 3; ++row) data[row][3] = t[row];
  }
  void SetTranslation(T x, T y, T z) { SetTranslation(Vector3<T>(x, y, z)); }
  Vector3<T> Translation() const { return {data[0][3], data[1][3], data[2][3]}; }
  Quaternion<T> Rotation() const { return Quaternion<T>(Upper()); }
  Vector3<T> EulerRotation(bool first = true) const {
    (void)first;
    return Rotation().Euler();
  }
  Pose3<T> Pose() const { return Pose3<T>(Translation(), Rotation()); }
  Vector3<T> Scale() const { return {data[0][0], data[1][1], data[2][2]}; }
  void Scale(const Vector3<T>& s) {
    for (int row = 0; row < 3; ++row) data[row][row] = s[row];
    data[3][3] = T(1);
  }
  bool IsAffine() const { return data[3][0] == T(0) && data[3][1] == T(0) && data[3][2] == T(0) && data[3][3] == T(1); }
  Vector3<T> TransformAffine(const Vector3<T>& v) const { return *this * v; }

  // Inverse by elimination with the largest pivots; of a singular matrix, not finite.
  Matrix4 Inverse() const {
    Matrix4 a = *this, result = Identity;
    for (int column = 0; column < 4; ++column) {
      int pivot = column;
      for (int row = column + 1; row < 4; ++row)
        if (std::abs(a.data[row][column]) > std::abs(a.data[pivot][column])) pivot = row;
      for (int k = 0; k < 4; ++k) {
        std::swap(a.data[column][k], a.data[pivot][k]);
        std::swap(result.data[column][k], result.data[pivot][k]);
      }
      const T divisor = a.data[column][column];
      for (int k = 0; k < 4; ++k) {
        a.data[column][k] /= divisor;
        result.data[column][k] /= divisor;
      }
      for (int row = 0; row < 4; ++row) {
        const T factor = a.data[row][column];
        for (int k = 0; row != column && k < 4; ++k) {
          a.data[row][k] -= factor * a.data[column][k];
          result.data[row][k] -= factor * result.data[column][k];
        }
      }
    }
    return result;
  }
  Matrix4 Transposed() const {
    Matrix4 result;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) result.data[column][row] = data[row][column];
    return result;
  }

  T operator()(std::size_t row, std::size_t column) const { return data[At(row)][At(column)]; }
  T& operator()(std::size_t row, std::size_t column) { return data[At(row)][At(column)]; }
  Matrix4 operator*(const Matrix4& o) const {
    Matrix4 result;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        for (int k = 0; k < 4; ++k) result.data[row][column] += data[row][k] * o.data[k][column];
    return result;
  }
  Matrix4 operator*=(const Matrix4& o) { return *this = *this * o; }
  Vector3<T> operator*(const Vector3<T>& v) const { return Upper() * v + Translation(); }
  const Matrix4& operator=(const Matrix3<T>& m) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) data[row][column] = m(row, column);
    return *this;
  }
  bool Equal(const Matrix4& o, const T& tolerance) const {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        if (!equal<T>(data[row][column], o.data[row][column], tolerance)) return false;
    return true;
  }
  bool operator==(const Matrix4& o) const { return Equal(o, T(1e-6)); }
  bool operator!=(const Matrix4& o) const { return !(*this == o); }
  friend std::ostream& operator<<(std::ostream& out, const Matrix4& m) {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) out << (row + column ? " " : "") << precision(m.data[row][column], 6);
    return out;
  }

 private:
  static std::size_t At(std::size_t index) { return std::min<std::size_t>(index, 3); }
  Matrix3<T> Upper() const {
    return {data[0][0], data[0][1], data[0][2], data[1][0], data[1][1], data[1][2], data[2][0], data[2][1], data[2][2]};
  }

  T data[4][4];
};

template <typename T>
const Matrix4<T> Matrix4<T>::Identity(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
template <typename T>
const Matrix4<T> Matrix4<T>::Zero;

typedef Matrix4<double> Matrix4d;
typedef Matrix4<float> Matrix4f;
typedef Matrix4<int> Matrix4i;

}  // namespace math
}  // namespace ignition

#endif

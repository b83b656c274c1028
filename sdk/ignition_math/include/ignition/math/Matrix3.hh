// Matrix of 3 rows and columns.
#ifndef IGNITION_MATH_MATRIX3_HH_
#define IGNITION_MATH_MATRIX3_HH_

#include <ignition/math/Quaternion.hh>

namespace ignition {
namespace math {

template <typename T>
class Matrix3 {
 public:
  static const Matrix3 Identity, Zero;

  Matrix3() : data{} {}
  Matrix3(T v00, T v01, T v02, T v10, T v11, T v12, T v20, T v21, T v22)
      : data{{v00, v01, v02}, {v10, v11, v12}, {v20, v21, v22}} {}
  explicit Matrix3(const Quaternion<T>& rotation) : data{} {
    const Quaternion<T> q = rotation.Normalized();
    Axes(q.XAxis(), q.YAxis(), q.ZAxis());
  }

  void Set(T v00, T v01, T v02, T v10, T v11, T v12, T v20, T v21, T v22) {
    *this = Matrix3(v00, v01, v02, v10, v11, v12, v20, v21, v22);
  }
  void Axes(const Vector3<T>& x, const Vector3<T>& y, const Vector3<T>& z) {
    Col(0, x);
    Col(1, y);
    Col(2, z);
  }
  void Axis(const Vector3<T>& axis, T angle) { *this = Matrix3(Quaternion<T>(axis, angle)); }
  void Col(unsigned int column, const Vector3<T>& values) {
    for (unsigned int row = 0; row < 3; ++row) data[row][std::min(column, 2u)] = values[row];
  }
  void SetCol(unsigned int column, const Vector3<T>& values) { Col(column, values); }
  T operator()(std::size_t row, std::size_t column) const { return data[At(row)][At(column)]; }
  T& operator()(std::size_t row, std::size_t column) { return data[At(row)][At(column)]; }

  T Determinant() const { return Row(0).Dot(Row(1).Cross(Row(2))); }
  Matrix3 Inverse() const {
    const T d = Determinant();
    const Vector3<T> a = Row(1).Cross(Row(2)) / d, b = Row(2).Cross(Row(0)) / d, c = Row(0).Cross(Row(1)) / d;
    Matrix3 result;
    result.Axes(a, b, c);
    return result;
  }
  Matrix3 Transposed() const {
    Matrix3 result;
    result.Axes(Row(0), Row(1), Row(2));
    return result;
  }
  void Transpose() { *this = Transposed(); }

  Matrix3 operator+(const Matrix3& o) const { return Combined(o, T(1)); }
  Matrix3 operator-(const Matrix3& o) const { return Combined(o, T(-1)); }
  Matrix3 operator*(const T& s) const { return Matrix3().Combined(*this, s); }
  friend Matrix3 operator*(T s, const Matrix3& m) { return m * s; }
  Vector3<T> operator*(const Vector3<T>& v) const { return {Row(0).Dot(v), Row(1).Dot(v), Row(2).Dot(v)}; }
  Matrix3 operator*(const Matrix3& o) const {
    Matrix3 result;
    for (unsigned int column = 0; column < 3; ++column) result.Col(column, *this * o.Column(column));
    return result;
  }
  bool Equal(const Matrix3& o, const T& tolerance) const {
    return Row(0).Equal(o.Row(0), tolerance) && Row(1).Equal(o.Row(1), tolerance) && Row(2).Equal(o.Row(2), tolerance);
  }
  bool operator==(const Matrix3& o) const { return Equal(o, T(1e-6)); }
  bool operator!=(const Matrix3& o) const { return !(*this == o); }
  friend std::ostream& operator<<(std::ostream& out, const Matrix3& m) {
    return out << m.Row(0) << ' ' << m.Row(1) << ' ' << m.Row(2);
  }

 private:
  static std::size_t At(std::size_t index) { return std::min<std::size_t>(index, 2); }
  Vector3<T> Row(int row) const { return {data[row][0], data[row][1], data[row][2]}; }
  Vector3<T> Column(int column) const { return {data[0][column], data[1][column], data[2][column]}; }
  Matrix3 Combined(const Matrix3& o, T factor) const {
    Matrix3 result;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        result.data[row][column] = data[row][column] + factor * o.data[row][column];
    return result;
  }

  T data[3][3];
};

template <typename T>
const Matrix3<T> Matrix3<T>::Identity(1, 0, 0, 0, 1, 0, 0, 0, 1);
template <typename T>
const Matrix3<T> Matrix3<T>::Zero;

template <typename T>
void Quaternion<T>::Matrix(const Matrix3<T>& m) {
  const T w = 1 + m(0, 0) + m(1, 1) + m(2, 2), x = 1 + m(0, 0) - m(1, 1) - m(2, 2);
  const T y = 1 - m(0, 0) + m(1, 1) - m(2, 2), z = 1 - m(0, 0) - m(1, 1) + m(2, 2);
  if (w >= x && w >= y && w >= z) *this = Quaternion(w, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
  else if (x >= y && x >= z) *this = Quaternion(m(2, 1) - m(1, 2), x, m(0, 1) + m(1, 0), m(0, 2) + m(2, 0));
  else if (y >= z) *this = Quaternion(m(0, 2) - m(2, 0), m(0, 1) + m(1, 0), y, m(1, 2) + m(2, 1));
  else *this = Quaternion(m(1, 0) - m(0, 1), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), z);
  Normalize();
}

typedef Matrix3<double> Matrix3d;
typedef Matrix3<float> Matrix3f;
typedef Matrix3<int> Matrix3i;

}  // namespace math
}  // namespace ignition

#endif

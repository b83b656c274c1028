#include <ignition/math/Color.hh>

namespace ignition {
namespace math {

const Color Color::White(1, 1, 1), Color::Black(0, 0, 0), Color::Red(1, 0, 0), Color::Green(0, 1, 0),
    Color::Blue(0, 0, 1), Color::Yellow(1, 1, 0), Color::Magenta(1, 0, 1), Color::Cyan(0, 1, 1);

}  // namespace math
}  // namespace ignition

// A light's orientation.
#include <cmath>

#include "ninebit/shadow/light_cookie.h"

namespace ninebit {
namespace {

struct SineCosine {
  double sine;
  double cosine;
};

// Polynomials, because the last bits of a mathematics library's functions differ between machines. Their argument is at
// most an eighth of a turn, where powers beyond the 17th are below a double's last bit.
SineCosine sine_cosine(double degrees) {
  const double turned = std::fmod(degrees, 360.0);
  const double quarters = std::floor(turned / 90.0 + 0.5);
  const double x = (turned - 90.0 * quarters) * (3.14159265358979323846 / 180.0);
  double sine = 1.0, cosine = 1.0;
  for (int k = 16; k >= 2; k -= 2) {
    sine = 1.0 - x * x / (k * (k + 1)) * sine;
    cosine = 1.0 - x * x / (k * (k - 1)) * cosine;
  }
  sine *= x;
  switch ((static_cast<int>(quarters) + 4) % 4) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

// The rotation about axis 0, 1 or 2.
glm::dmat3 rotation(int axis, double degrees) {
  const auto [sine, cosine] = sine_cosine(degrees);
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  glm::dmat3 m(1.0);
  m[next][next] = cosine;
  m[next][last] = sine;
  m[last][next] = -sine;
  m[last][last] = cosine;
  return m;
}

}  // namespace

glm::mat3 light_rotation(const glm::vec3& degrees) {
  return glm::mat3(rotation(2, static_cast<double>(degrees.z)) * rotation(1, static_cast<double>(degrees.y)) *
                   rotation(0, static_cast<double>(degrees.x)));
}

}  // namespace ninebit

#include "src/scene/files/up_axis.h"

namespace ninebit {

void turn_up(UpAxis up, Scene& scene) {
  const float sign = up == UpAxis::z ? 1.0F : -1.0F;
  // Sums with 0 turn -0 into 0, as the readers do.
  const auto turn = [&](glm::vec3& v) { v = glm::vec3(v.x, sign * v.z, -sign * v.y) + 0.0F; };
  for (glm::vec3& v : scene.positions) turn(v);
  for (glm::vec3& v : scene.normals) turn(v);
  for (glm::vec4& t : scene.tangents) {
    glm::vec3 v(t);
    turn(v);
    t = glm::vec4(v, t.w);
  }
  for (Camera& camera : scene.cameras) {
    turn(camera.position);
    turn(camera.look_at);
    turn(camera.up);
  }
  for (Light& light : scene.lights) {
    turn(light.position);
    turn(light.direction);
  }
}

}  // namespace ninebit

#include <gtest/gtest.h>
#include <ninebit/shadow/light_cookie.h>

#include <memory>

TEST(Examples, LightCookie) {
  using namespace ninebit;
  const glm::mat3 quarter = light_rotation({0.0F, 90.0F, 0.0F});
  EXPECT_EQ(quarter * glm::vec3(0, 0, 1), glm::vec3(1, 0, 0));

  RenderSettings settings;
  settings.light_cookie.cookie = std::make_shared<const Texture>();  // a cube map, see read_cube_texture
  settings.light_cookie.rotate_degrees = {0.0F, 90.0F, 0.0F};
  EXPECT_TRUE(light_cookie_pass(settings)->program.has_value());
}

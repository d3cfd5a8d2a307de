#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/combiner/program.h>
#include <ninebit/language/xbox_pixel_shader.h>
#include <ninebit/numerics/hardware_profile.h>

#include <string>
#include <vector>

TEST(Examples, XboxPixelShader) {
  using namespace ninebit;
  const Result<std::string> definition = print_xbox_pixel_shader(CombinerState{}, profiles::nv2a);
  ASSERT_TRUE(is_xbox_pixel_shader(*definition));
  std::vector<RegisterWord> texture_modes;
  const auto state = parse_xbox_pixel_shader({*definition, "title.h"}, profiles::nv2a, &texture_modes);
  ASSERT_TRUE(state);
  EXPECT_EQ(normalize(*state, profiles::nv2a), normalize({}, profiles::nv2a));
  EXPECT_EQ(texture_modes.size(), kOtherWordNames.size());
}
